// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/sized_cost_function.h>

#include "manifolds/se3.h"

namespace trajlo {

/// A known velocity of one segment.
///
///   e = (T_end ⊖ T_begin) - tau_expected,   r = [e_rho / sigma_rho; e_theta / sigma_theta]
///
/// This is the paper's smoothness constraint, where `tau_expected` is the pseudo-velocity
/// measurement Ť_{k-1} ⊖ Ť_{k-2} of the previous solve: a constant. Here it also holds the first
/// segment, before which there is no other. Jacobians (paper, end of "Analytic Jacobian
/// Derivation"), tau = T_end ⊖ T_begin:
///
///   de/dT_begin = -Jl⁻¹(tau),   de/dT_end = Jr⁻¹(tau).
struct SmoothnessTerm {
  Vector6d tau_expected = Vector6d::Zero();
  /// 1/sigma by component: translation (1/m) first, then rotation (1/rad).
  Vector6d sqrt_information = Vector6d::Ones();

  Vector6d Residual(const SE3& T_begin, const SE3& T_end) const;
  Eigen::Matrix<double, 6, 12> Jacobian(const SE3& T_begin, const SE3& T_end) const;
};

/// SmoothnessTerm as a Ceres block. Parameter blocks: T_begin, T_end.
class SmoothnessCost final : public ceres::SizedCostFunction<6, 7, 7> {
 public:
  /// `term` must outlive the factor; each evaluation reads it anew.
  explicit SmoothnessCost(const SmoothnessTerm* term) : term_(term) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const SmoothnessTerm* term_;
};

}  // namespace trajlo
