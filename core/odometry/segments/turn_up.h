// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "manifolds/eigen_abi.h"

namespace trajlo {

/// Turns the ray to `p` up by `angle_rad` about the horizontal axis p x z, which is perpendicular
/// to it: the calibration error of a LiDAR's vertical angles (SegmenterOptions).
inline Eigen::Vector3f TurnUp(const Eigen::Vector3f& p, float angle_rad) {
  if (angle_rad == 0.0F) return p;
  const Eigen::Vector3f axis = p.cross(Eigen::Vector3f::UnitZ());
  const float norm = axis.norm();
  if (norm < 1e-6F) return p;
  return p * std::cos(angle_rad) + (axis / norm).cross(p) * std::sin(angle_rad);
}

}  // namespace trajlo
