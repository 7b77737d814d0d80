// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/sized_cost_function.h>

#include "manifolds/se3.h"

namespace trajlo {

/// What ties two neighbouring segments: a body whose acceleration is white noise.
///
///   e = tau_2 / Δt_2 - tau_1 / Δt_1,   tau_1 = T_1 ⊖ T_0,   tau_2 = T_2 ⊖ T_1,
///   r = e / sigma,                     sigma² = q (Δt_1 + Δt_2) / 3
///
/// or, if the velocity returns to a mean m, keeping a share a of what it has beyond it,
///
///   e = (tau_2 / Δt_2 - m) - a (tau_1 / Δt_1 - m)
///
/// with q the spectral density of the acceleration, of each component: m²/s³ for translation,
/// rad²/s³ for rotation. tau / Δt is the mean velocity over a segment. The velocity is a Wiener
/// process, and the means of one over two neighbouring intervals differ by a variance of
/// q (Δt_1 + Δt_2) / 3: so the same q means the same motion whatever the intervals are.
/// Neighbouring differences share a segment, and are correlated by a quarter where intervals are
/// equal. A window takes them for independent: over many segments its velocity varies by 2/3 of
/// what q says. Densities are learnt from innovations, each of which adds one difference, for which
/// q holds.
///
/// All three poses are variables: the velocity before is as uncertain as the points left it. (The
/// paper takes the estimated one for exact, see SmoothnessTerm; then a prior that is too stiff
/// confirms itself.) Jacobians with respect to right perturbations:
///
///   de/dT_0 = a Jl⁻¹(tau_1)/Δt_1,   de/dT_1 = -Jl⁻¹(tau_2)/Δt_2 - a Jr⁻¹(tau_1)/Δt_1,
///   de/dT_2 = Jr⁻¹(tau_2)/Δt_2.
///
/// Source: T. Barfoot, State Estimation for Robotics, 2017, section 11.1 (the prior in continuous
/// time); here for the mean velocities of segments. A velocity that returns: G. Uhlenbeck and
/// L. Ornstein, On the theory of the Brownian motion, 1930.
struct WhiteNoiseAccelerationTerm {
  double first_s = 0.0;   ///< Δt_1
  double second_s = 0.0;  ///< Δt_2
  /// 1/sigma by component: translation (s/m) first, then rotation (s/rad).
  Vector6d sqrt_information = Vector6d::Zero();
  Vector6d persistence = Vector6d::Ones();    ///< a, by component: 1 if the velocity is kept.
  Vector6d mean_velocity = Vector6d::Zero();  ///< m, [rho; theta] per second.

  WhiteNoiseAccelerationTerm() = default;
  /// `density`: q by component, translation (m²/s³) first, then rotation (rad²/s³).
  WhiteNoiseAccelerationTerm(const Vector6d& density, double delta_1_s, double delta_2_s);

  Vector6d Residual(const SE3& T_0, const SE3& T_1, const SE3& T_2) const;
  Eigen::Matrix<double, 6, 18> Jacobian(const SE3& T_0, const SE3& T_1, const SE3& T_2) const;
};

/// WhiteNoiseAccelerationTerm as a Ceres block. Parameter blocks: T_0, T_1, T_2.
class WhiteNoiseAccelerationCost final : public ceres::SizedCostFunction<6, 7, 7, 7> {
 public:
  /// `term` must outlive the factor; each evaluation reads it anew.
  explicit WhiteNoiseAccelerationCost(const WhiteNoiseAccelerationTerm* term) : term_(term) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const WhiteNoiseAccelerationTerm* term_;
};

}  // namespace trajlo
