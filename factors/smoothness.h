// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/sized_cost_function.h>

#include <optional>

#include "manifolds/se3.h"

namespace trajlo {

/// The smoothness constraint of one segment: what makes the trajectory keep its velocity.
///
///   e = (T_end ⊖ T_begin) - tau_expected,   r = [e_rho / sigma_rho; e_theta / sigma_theta]
///
/// `tau_expected` is the pseudo-velocity measurement of the paper, Ť_{k-1} ⊖ Ť_{k-2} of the
/// previous solve (scaled by the ratio of intervals where they differ): a constant. Jacobians
/// (paper, end of "Analytic Jacobian Derivation"), tau = T_end ⊖ T_begin:
///
///   de/dT_begin = -Jl⁻¹(tau),   de/dT_end = Jr⁻¹(tau).
struct SmoothnessTerm {
  Vector6d tau_expected = Vector6d::Zero();
  /// 1/sigma by component: translation (1/m) first, then rotation (1/rad).
  Vector6d sqrt_information = Vector6d::Ones();

  struct Linearization {
    Vector6d residual;
    Matrix6d wrt_begin, wrt_end;
  };
  /// With `T_begin_linearized`, the Jacobians are first-estimate Jacobians, taken there.
  Linearization Linearize(const SE3& T_begin, const SE3& T_end,
                          const std::optional<SE3>& T_begin_linearized = std::nullopt) const;
  Vector6d Residual(const SE3& T_begin, const SE3& T_end) const;
};

/// SmoothnessTerm as a Ceres block. Parameter blocks: T_begin, T_end.
class SmoothnessCost final : public ceres::SizedCostFunction<6, 7, 7> {
 public:
  explicit SmoothnessCost(const SmoothnessTerm& term,
                          const std::optional<SE3>& T_begin_linearized = std::nullopt)
      : term_(term), T_begin_linearized_(T_begin_linearized) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  SmoothnessTerm term_;
  std::optional<SE3> T_begin_linearized_;
};

}  // namespace trajlo
