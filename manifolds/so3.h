// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "manifolds/eigen_abi.h"

/// SO(3): rotations as unit quaternions, tangent vectors theta in radians.
/// Notation and formulas: J. Solà et al., A micro Lie theory for state estimation in robotics,
/// 2018, appendix B. All functions are exact at 0, accurate to about 1e-15 near it, and safe up to
/// an angle of pi (the inverse Jacobians up to 2 pi, where they are singular by nature).
namespace trajlo::so3 {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// The matrix [v]x of the cross product: Hat(v) w = v x w.
inline Matrix3d Hat(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Exp: R³ → SO(3), q = [sin(|theta|/2) theta/|theta|, cos(|theta|/2)].
Quaterniond Exp(const Vector3d& theta);

/// Log: SO(3) → R³ with |theta| <= pi; the sign of q does not matter.
Vector3d Log(const Quaterniond& q);

/// The inverse of Jl(theta), with which Exp(theta + d) = Exp(Jl d) Exp(theta) to first order:
/// Jl⁻¹(theta) = I - [theta]x/2 + (1 - c1/(2 c2)) / |theta|² [theta]x².
Matrix3d LeftJacobianInverse(const Vector3d& theta);

}  // namespace trajlo::so3
