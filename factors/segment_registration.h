// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/sized_cost_function.h>

#include <optional>
#include <vector>

#include "factors/segment_linearizer.h"

namespace trajlo {

/// The registration of a whole segment as one block of 13 residuals with the cost, gradient and
/// Gauss-Newton Hessian of one PointToPlaneCost per point with a RobustKernelLoss. With the normal
/// equations H = SᵀS and Sᵀs = g at the present poses,
///
///   residual = [s; sqrt(2 cost - |s|²)],  Jacobian = [S; 0].
///
/// The root is real because every kernel is concave: |s|² = gᵀH⁻¹g <= sum rho'(s_i) s_i <= 2 cost.
/// Without Jacobians only the norm matters: residual = [0; sqrt(2 cost)].
/// Parameter blocks: T_begin, T_end.
///
/// This one takes normal equations that a ceres::EvaluationCallback has already computed for the
/// state that is being evaluated (for all segments of a window in parallel).
class PreparedRegistrationCost final : public ceres::SizedCostFunction<13, 7, 7> {
 public:
  /// `equations` must outlive the factor.
  explicit PreparedRegistrationCost(const RegistrationNormalEquations* equations)
      : equations_(equations) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const RegistrationNormalEquations* equations_;
};

/// The same block, which computes its normal equations by itself. Ceres asks for the cost of a step
/// and then, as nearly every step is accepted, for the Jacobians at the same poses: both are
/// computed in one pass and kept for the second question.
class SegmentRegistrationCost final : public ceres::SizedCostFunction<13, 7, 7> {
 public:
  /// `points` must outlive the factor and stay as they are.
  SegmentRegistrationCost(const std::vector<RegistrationPoint>* points,
                          const RegistrationNoise& noise)
      : points_(points), noise_(noise) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const std::vector<RegistrationPoint>* points_;
  RegistrationNoise noise_;
  /// The last answer and its poses; a block is evaluated by one thread at a time.
  mutable std::optional<LinearizedRegistration> last_;
};

}  // namespace trajlo
