// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "manifolds/se3.h"

namespace trajlo {

/// True if the numbers are finite, and so is their length: with 1e200 in it a quaternion would be
/// normalised to zero.
template <typename Numbers>
bool HasFiniteLength(const Eigen::MatrixBase<Numbers>& numbers) {
  return std::isfinite(numbers.squaredNorm());
}

/// True if what was read from a file can be a pose: also one that has flown off to 1e200 m.
inline bool HasFiniteLength(const SE3& pose) {
  return HasFiniteLength(pose.q.coeffs()) && pose.t.allFinite();
}

}  // namespace trajlo
