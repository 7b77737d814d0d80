// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/odometry/segments/segmenter.h"
#include "core/odometry/trajectory/trajectory.h"
#include "core/odometry/trajectory/trajectory_cursor.h"
#include "core/scans/lidar_scan.h"

namespace trajlo {

/// What became of the points so far.
struct PlacementCounts {
  std::size_t placed = 0;
  std::size_t unusable = 0;  ///< NaN, too near or too far: the estimator does not use them either.
  std::size_t outside = 0;   ///< Before the first or after the last pose.
  std::size_t in_pause = 0;  ///< Where nobody knows how the sensor moved.

  std::size_t Received() const { return placed + unusable + outside + in_pause; }
};

/// A scan whose points lie where they were measured.
struct PlacedScan {
  int lidar_id = 0;
  /// When the last of the points was measured, and where the body was then.
  std::int64_t t_ns = 0;
  SE3 T_world_body;
  std::vector<Eigen::Vector3d> points_world_m;
  std::vector<float> intensities;
};

/// Places the points of scans by the pose at the time of each, as the method moves them: by the
/// constant twist between two poses.
class ScanPlacer {
 public:
  /// `trajectory` must outlive this and not change.
  ScanPlacer(const Trajectory* trajectory, const SegmenterOptions& segmenter);

  /// Nothing if no point of the scan can be placed. Times are those that the estimator used.
  std::optional<PlacedScan> Place(const LidarScan& scan);
  const PlacementCounts& counts() const { return counts_; }

 private:
  const Trajectory* trajectory_;
  SegmenterOptions segmenter_;
  TrajectoryCursor cursor_;
  PlacementCounts counts_;
};

}  // namespace trajlo
