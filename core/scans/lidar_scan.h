// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "manifolds/eigen_abi.h"

namespace trajlo {

/// One return of a LiDAR, in the frame of that LiDAR.
struct LidarPoint {
  Eigen::Vector3f xyz_m = Eigen::Vector3f::Zero();
  float intensity = 0.0F;
  /// When the point was measured; absolute, in the clock of the recording.
  std::int64_t t_ns = 0;
};

/// What a reader hands on: the returns of one message or file of one LiDAR.
/// Points are in the order of the file; they need not be sorted by time and may hold NaN.
struct LidarScan {
  /// Which LiDAR of the rig measured it, counted from 0.
  int lidar_id = 0;
  /// The scan's own stamp, as written beside or in the file.
  std::int64_t stamp_ns = 0;
  /// When it was recorded, by the recorder's clock, where that is known.
  std::optional<std::int64_t> recorded_ns = std::nullopt;
  /// False for motion-corrected scans: every `t_ns` then equals `stamp_ns`.
  bool has_point_times = true;
  std::vector<LidarPoint> points;
};

}  // namespace trajlo
