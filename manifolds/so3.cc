// SPDX-License-Identifier: MIT
#include "manifolds/so3.h"

#include <cmath>

#include "manifolds/stumpff.h"

namespace trajlo::so3 {

Quaterniond Exp(const Vector3d& theta) {
  const Stumpff half(0.25 * theta.squaredNorm());
  const Vector3d v = 0.5 * half.c1 * theta;
  return Quaterniond(half.c0, v.x(), v.y(), v.z());
}

Vector3d Log(const Quaterniond& q) {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const double w = sign * q.w();
  const Vector3d v = sign * q.vec();
  const double n = v.norm();
  // atan2 is accurate both near 0 and near pi (where w vanishes); 2 atan(n/w)/n → 2/w as n → 0.
  const double scale = n < 1e-8 ? 2.0 / w : 2.0 * std::atan2(n, w) / n;
  return scale * v;
}

Matrix3d LeftJacobianInverse(const Vector3d& theta) {
  const double angle_squared = theta.squaredNorm();
  const Stumpff s(angle_squared);
  // 1 - c1/(2 c2) = (2 c2 - c1)/(2 c2), and 2 c2 - c1 = |theta|² (c3 - 2 c4): no division by 0.
  const double b = (s.c3 - 2.0 * s.c4) / (2.0 * s.c2);
  const Matrix3d hat = Hat(theta);
  return Matrix3d::Identity() - 0.5 * hat + b * hat * hat;
}

}  // namespace trajlo::so3
