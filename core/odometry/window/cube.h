// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>

#include "core/odometry/map/voxel_index.h"

namespace trajlo {

/// A cube of space, as a key of ordered containers: floor(p / edge).
using Cube = std::array<int, 3>;

inline Cube CubeAt(const Eigen::Vector3d& p, double edge_m) {
  const VoxelKey key = VoxelAt(p, 1.0 / edge_m);
  return {key.x(), key.y(), key.z()};
}

}  // namespace trajlo
