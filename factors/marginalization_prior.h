// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/sized_cost_function.h>

#include "factors/segment_registration.h"
#include "manifolds/se3.h"

namespace trajlo {

/// What a window keeps of the poses that have left it (paper, "Joint Optimization and
/// Marginalization"), on the pose s that becomes the oldest:
///
///   E(s) = ½ dᵀ H d + bᵀ d,   d = s ⊖ s̄,
///
/// in square-root form: r = S d + r0 with SᵀS = H and Sᵀr0 = b, so that E = ½ |r|² up to a
/// constant.
struct MarginalizationPrior {
  SE3 linearization_point;                       ///< s̄
  Matrix6d sqrt_information = Matrix6d::Zero();  ///< S
  Vector6d offset = Vector6d::Zero();            ///< r0

  Matrix6d Information() const { return sqrt_information.transpose() * sqrt_information; }
  Vector6d Gradient() const { return sqrt_information.transpose() * offset; }

  Vector6d Residual(const SE3& pose) const {
    return offset + sqrt_information * Minus(pose, linearization_point);
  }
  /// S Jr⁻¹(d); with first-estimate Jacobians d = 0 and it is S itself.
  Matrix6d Jacobian(const SE3& pose, bool first_estimate) const;
};

/// A prior of independent standard deviations: holds the first pose of a trajectory.
MarginalizationPrior MakeAnchor(const SE3& pose, double sigma_translation_m,
                                double sigma_rotation_rad);

/// Eliminates the leaving pose from the quadratic ½ xᵀH x + gᵀx of x = [leaving; staying] (all
/// terms that touch the leaving pose, linearised where the window was left) by the Schur complement
///
///   H_m = H_ss - H_sl H_ll⁺ H_ls,   b_m = g_s - H_sl H_ll⁺ g_l,
///
/// and returns it as a prior on the staying pose around `linearization_point`.
/// Source: Demmel et al., Square Root Marginalization for Sliding-Window Bundle Adjustment, 2021,
/// section 3. Directions of the leaving pose without information are left out of H_ll⁺.
MarginalizationPrior MarginalizeSchur(const Matrix12d& H, const Vector12d& g,
                                      const SE3& linearization_point);

/// The same by orthogonal elimination, without ever forming H: QR of the stacked [J_l J_s | r]; the
/// rows below the leaving pose are the prior. `jacobian` is rows x 12, leaving pose first.
MarginalizationPrior MarginalizeQr(const Eigen::Matrix<double, Eigen::Dynamic, 12>& jacobian,
                                   const Eigen::VectorXd& residual, const SE3& linearization_point);

/// MarginalizationPrior as a Ceres block on one pose.
class MarginalizationPriorCost final : public ceres::SizedCostFunction<6, 7> {
 public:
  MarginalizationPriorCost(const MarginalizationPrior& prior, bool first_estimate_jacobians)
      : prior_(prior), first_estimate_jacobians_(first_estimate_jacobians) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  MarginalizationPrior prior_;
  bool first_estimate_jacobians_;
};

}  // namespace trajlo
