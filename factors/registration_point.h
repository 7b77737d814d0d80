// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "manifolds/eigen_abi.h"

namespace trajlo {

/// A measured point with the plane of the map that it was associated with.
struct RegistrationPoint {
  Eigen::Vector3d p_body_m;      ///< The point in the body frame at its own time.
  double alpha = 0.0;            ///< Its time within the segment: 0 begin, 1 end.
  Eigen::Vector3d normal_world;  ///< Unit normal n of the plane nᵀx = d.
  double offset_m = 0.0;         ///< d.
  double weight = 1.0;           ///< Relative information of the association, in (0, 1].
  /// By how much the noise of its map points tilts the plane: the variance of n in every direction
  /// within the plane (rad²). Infinite: the plane may be no surface at all.
  double normal_variance_rad2 = 0.0;
  /// Size of the plane's voxels, in those of the finest level; 1 for a wide and thin plane.
  double coarseness = 1.0;
  /// Which of the window's three axes the normal is nearest to: 0, 1 or 2. See
  /// RegistrationNoise::widening.
  std::uint32_t axis = 0;
  std::uint32_t lidar = 0;  ///< Which LiDAR measured it.

  /// nᵀx - d, metres, of the point at `x_world`.
  double DistanceToPlane(const Eigen::Vector3d& x_world) const {
    return normal_world.dot(x_world) - offset_m;
  }
};

}  // namespace trajlo
