// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/odometry/map/voxel_hash_map.h"
#include "core/odometry/parallel/thread_pool.h"
#include "manifolds/se3.h"

namespace trajlo {

/// Where a body can be after a time unseen.
struct SearchRegion {
  Eigen::Vector3d center_world = Eigen::Vector3d::Zero();
  double radius_m = 0.0;
  /// Attitudes, each to be turned about turn_axis_world by mean_turn_rad ± max_turn_rad.
  std::vector<Eigen::Quaterniond> q_world_body;
  Eigen::Vector3d turn_axis_world = Eigen::Vector3d::UnitZ();
  double mean_turn_rad = 0.0;
  double max_turn_rad = 0.0;

  /// Whether a position is in it.
  bool Holds(const Eigen::Vector3d& t_world) const {
    return (t_world - center_world).norm() <= radius_m;
  }
};

/// Poses in `region` at which many points of a rigid sweep (body frame) fall into occupied cells of
/// the map, best first; at most `count`, no two of them close together. The whole region is looked
/// through, coarse blocks of positions first: of each block a bound says how many points can hit
/// anything anywhere in it. As in W. Hess et al., Real-time loop closure in 2D LIDAR SLAM, ICRA
/// 2016, but in three dimensions and level by level, with a bounded number of blocks on each.
std::vector<SE3> FindPlaces(const std::vector<Eigen::Vector3d>& sweep_body, const VoxelHashMap& map,
                            const SearchRegion& region, std::size_t count, ThreadPool* threads);

}  // namespace trajlo
