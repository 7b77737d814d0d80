// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <vector>

#include "manifolds/se3.h"

namespace trajlo {

/// What a window keeps of the poses that have left it (paper, "Joint Optimization and
/// Marginalization"), on the first n poses s of what stays:
///
///   E(s) = ½ dᵀ H d + bᵀ d,   d = [s_1 ⊖ s̄_1; ...; s_n ⊖ s̄_n],
///
/// in square-root form: r = S d + r0 with SᵀS = H and Sᵀr0 = b, so that E = ½ |r|² up to a
/// constant. n is 1 where the pose that left was tied to one pose, 2 where its velocity was, too.
struct MarginalizationPrior {
  std::vector<SE3> linearization_points;  ///< s̄
  Eigen::MatrixXd sqrt_information;       ///< S, 6n x 6n.
  Eigen::VectorXd offset;                 ///< r0
  /// Off: the Jacobian is the derivative of the residual, S Jr⁻¹(d). On: it stays as it was where
  /// the poses left (d = 0), which is S. This applies to the prior only; in Huang et al. (2009),
  /// all factors on its poses keep theirs.
  bool first_estimate_jacobians = false;

  int poses() const { return static_cast<int>(linearization_points.size()); }

  /// `s` has at least poses() poses. The Jacobian is with respect to their right perturbations.
  Eigen::VectorXd Residual(const std::vector<SE3>& s) const;
  Eigen::MatrixXd Jacobian(const std::vector<SE3>& s) const;
};

/// A prior of independent standard deviations: holds the first pose of a trajectory.
MarginalizationPrior MakeAnchor(const SE3& pose, double sigma_translation_m,
                                double sigma_rotation_rad);

/// Eliminates the leaving pose from the quadratic ½ xᵀH x + gᵀx of x = [leaving; staying] (all
/// terms that touch the leaving pose, linearised where the window was left) by the Schur complement
///
///   H_m = H_ss - H_sl H_ll⁺ H_ls,   b_m = g_s - H_sl H_ll⁺ g_l,
///
/// and returns it as a prior around `staying`, the one or more poses that it touches.
/// Source: Demmel et al., Square Root Marginalization for Sliding-Window Bundle Adjustment, 2021,
/// section 3. Directions of the leaving pose without information are left out of H_ll⁺.
MarginalizationPrior MarginalizeSchur(const Eigen::MatrixXd& H, const Eigen::VectorXd& g,
                                      const std::vector<SE3>& staying);

/// MarginalizationPrior as a Ceres block on its poses.
class MarginalizationPriorCost final : public ceres::CostFunction {
 public:
  /// `prior` must outlive the factor and keep its number of poses; each evaluation reads it anew.
  explicit MarginalizationPriorCost(const MarginalizationPrior* prior);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const MarginalizationPrior* prior_;
};

}  // namespace trajlo
