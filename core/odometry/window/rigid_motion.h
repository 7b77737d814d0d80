// SPDX-License-Identifier: MIT
#pragma once

#include "factors/segment_linearizer.h"
#include "manifolds/se3.h"

namespace trajlo {

/// Where the right perturbation xi of `T_frame` moves both ends of a segment, if all that is there
/// moves as one rigid body: T_frame Exp(xi) T_frame⁻¹ T_j = T_j Exp(A_j xi), exactly, with
/// A_j = Adj(T_j⁻¹ T_frame). So with A = [A_begin; A_end] the normal equations H, g of the segment
/// become AᵀH A, Aᵀg of the rigid motion.
inline Eigen::Matrix<double, 12, 6> RigidMotionOfEnds(const SE3& T_frame, const SE3& T_begin,
                                                      const SE3& T_end) {
  Eigen::Matrix<double, 12, 6> A;
  A << se3::Adjoint(T_begin.Inverse() * T_frame), se3::Adjoint(T_end.Inverse() * T_frame);
  return A;
}

}  // namespace trajlo
