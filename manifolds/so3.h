// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "manifolds/eigen_abi.h"
#include "manifolds/stumpff.h"

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
inline Quaterniond Exp(const Vector3d& theta) {
  const Stumpff half(0.25 * theta.squaredNorm());
  const Vector3d v = 0.5 * half.c1 * theta;
  return Quaterniond(half.c0, v.x(), v.y(), v.z());
}

/// Log: SO(3) → R³ with |theta| <= pi; the sign of q does not matter.
inline Vector3d Log(const Quaterniond& q) {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const double w = sign * q.w();
  const Vector3d v = sign * q.vec();
  const double n = v.norm();
  // atan2 is accurate both near 0 and near pi (where w vanishes); 2 atan(n/w)/n → 2/w as n → 0.
  const double scale = n < 1e-8 ? 2.0 / w : 2.0 * std::atan2(n, w) / n;
  return scale * v;
}

/// The inverse of Jl(theta), with which Exp(theta + d) = Exp(Jl d) Exp(theta) to first order:
/// Jl⁻¹(theta) = I - [theta]x/2 + (1 - c1/(2 c2)) / |theta|² [theta]x².
inline Matrix3d LeftJacobianInverse(const Vector3d& theta) {
  const double angle_squared = theta.squaredNorm();
  const Stumpff s(angle_squared);
  // 1 - c1/(2 c2) = (2 c2 - c1)/(2 c2), and 2 c2 - c1 = |theta|² (c3 - 2 c4): no division by 0.
  const double b = (s.c3 - 2.0 * s.c4) / (2.0 * s.c2);
  const Matrix3d hat = Hat(theta);
  return Matrix3d::Identity() - 0.5 * hat + b * hat * hat;
}

}  // namespace trajlo::so3
