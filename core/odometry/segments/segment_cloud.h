// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/odometry/segments/lidar_correction.h"
#include "core/scans/nanoseconds.h"
#include "core/scans/sight_lines.h"
#include "manifolds/eigen_abi.h"

namespace trajlo {

/// A point of a segment in the body frame at its own time; `alpha` is that time as a share of the
/// segment: 0 at its start, 1 at its end.
struct SegmentPoint {
  Eigen::Vector3f p_body_m;
  float alpha;
  std::uint16_t lidar = 0;  ///< Which LiDAR measured it.
};

/// What became of the points that the readers delivered.
struct PointCounts {
  std::int64_t received = 0;
  std::int64_t not_finite = 0;
  std::int64_t too_near = 0;  ///< Includes the (0, 0, 0) of a missing return.
  std::int64_t too_far = 0;
  std::int64_t too_late = 0;    ///< Older than what was already processed.
  std::int64_t wrong_time = 0;  ///< Of scans whose stamps are wrong, or far from their own scan.
  SightLines sight_lines;       ///< Of a scan every two seconds.

  std::int64_t Kept() const {
    return received - not_finite - too_near - too_far - too_late - wrong_time;
  }
};

/// All that the LiDARs measured in [begin_ns, end_ns), merged in the body frame and thinned twice.
struct SegmentCloud {
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
  /// True for the one long, empty segment that stands for a pause in the recording.
  bool is_gap = false;
  /// True for scans that were motion-corrected or have no point times: all belongs to the end.
  bool is_instant = false;
  /// Where each LiDAR is in the body frame.
  std::vector<Eigen::Vector3d> lidar_origins_body_m;
  /// What the points of each LiDAR are corrected by.
  std::vector<LidarCorrection> corrections;
  std::vector<SegmentPoint> map_points;           ///< Fine: what enters the map.
  std::vector<SegmentPoint> registration_points;  ///< Coarse subset: what is registered.

  double Duration_s() const { return Seconds(end_ns - begin_ns); }
};

}  // namespace trajlo
