// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "manifolds/se3.h"

namespace trajlo {

/// The way of a LiDAR through a segment, straight and even.
struct LidarPath {
  Eigen::Vector3d begin_world, way_world;

  /// `alpha`: the share of the segment's time that has gone by.
  Eigen::Vector3d At(double alpha) const { return begin_world + alpha * way_world; }
};

/// One for each LiDAR.
inline std::vector<LidarPath> LidarPaths(const std::vector<Eigen::Vector3d>& origins_body_m,
                                         const SE3& T_begin, const SE3& T_end) {
  std::vector<LidarPath> paths;
  for (const Eigen::Vector3d& origin : origins_body_m) {
    paths.push_back({T_begin * origin, T_end * origin - T_begin * origin});
  }
  return paths;
}

}  // namespace trajlo
