// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/odometry/map/map_pyramid.h"
#include "core/odometry/parallel/parallel_for.h"
#include "core/odometry/sensing/segment_cloud.h"
#include "factors/registration_point.h"
#include "manifolds/se3.h"

namespace trajlo {

/// The planes of one segment's points, kept from round to round while the segment does not move.
class SegmentAssociation {
 public:
  /// Looks up a plane for every point, at its own time on T_begin..T_end; nothing is looked up
  /// where the segment lies where it did at the last look-up. `lidar_origins_body_m` says where
  /// each point's LiDAR is. `associated` receives the points that have a plane, in the order of
  /// `points`; it stays as it is where nothing is looked up. Returns the number of look-ups.
  int Associate(const std::vector<SegmentPoint>& points,
                const std::vector<Eigen::Vector3d>& lidar_origins_body_m, const SE3& T_begin,
                const SE3& T_end, const MapPyramid& map, ThreadPool* threads,
                std::vector<RegistrationPoint>* associated);

 private:
  bool HasMoved(const SE3& T_begin, const SE3& T_end) const;

  bool is_associated_ = false;
  SE3 T_begin_, T_end_;  ///< At the last look-up.
  std::vector<std::size_t> chunk_found_;
};

}  // namespace trajlo
