// SPDX-License-Identifier: MIT
#pragma once

#include "manifolds/se3.h"

namespace trajlo {

/// The pose within a segment (paper eq. 1): phi(alpha) = T_begin ⊕ alpha tau with
/// tau = T_end ⊖ T_begin; alpha is 0 at the begin and 1 at the end of the segment.
inline SE3 Interpolate(const SE3& T_begin, const SE3& T_end, double alpha) {
  return Plus(T_begin, alpha * Minus(T_end, T_begin));
}

/// The derivatives of the interpolated pose, all with respect to right perturbations.
struct InterpolationJacobians {
  Matrix6d wrt_begin;  ///< (1 - alpha) Jr((alpha - 1) tau) Jl⁻¹(tau), paper's Jacobian c.
  Matrix6d wrt_end;    ///< alpha Jr(alpha tau) Jr⁻¹(tau), paper's Jacobian d.
};

inline InterpolationJacobians InterpolateJacobians(const Vector6d& tau, double alpha) {
  return {(1.0 - alpha) * se3::RightJacobian((alpha - 1.0) * tau) * se3::LeftJacobianInverse(tau),
          alpha * se3::RightJacobian(alpha * tau) * se3::RightJacobianInverse(tau)};
}

}  // namespace trajlo
