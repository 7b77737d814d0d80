// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/sized_cost_function.h>

#include "factors/registration_point.h"
#include "manifolds/se3_interpolation.h"

namespace trajlo {

/// The residual of one point, and its Jacobian with respect to the right perturbations of both
/// control poses if `wrt_poses` is given. See PointToPlaneCost for the formulas.
double EvaluatePointToPlane(const RegistrationPoint& point, double sigma_m, const SE3& T_begin,
                            const SE3& T_end, Eigen::Matrix<double, 1, 12>* wrt_poses);

/// The continuous-time geometric constraint of one point (the paper's geometric error), the plain
/// reference for SegmentRegistrationCost:
///
///   r = sqrt(w)/sigma · (nᵀ phi(alpha) p - d),   phi(alpha) = T_begin ⊕ alpha (T_end ⊖ T_begin)
///
/// with p the point in the body frame (the extrinsic is already applied), (n, d) the plane
/// nᵀx = d in the world frame, w the point's relative weight. Parameter blocks: T_begin, T_end,
/// each [qx qy qz qw tx ty tz]. Jacobians: paper's a to d,
///
///   dr/dphi = sqrt(w)/sigma nᵀ [R  -R [p]x],  chained with InterpolateJacobians().
///
/// A robust kernel is given to Ceres as the block's loss (RobustKernelLoss).
class PointToPlaneCost final : public ceres::SizedCostFunction<1, 7, 7> {
 public:
  /// `sigma_m`: standard deviation of the point-to-plane distance, metres.
  PointToPlaneCost(const RegistrationPoint& point, double sigma_m)
      : point_(point), sigma_m_(sigma_m) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  RegistrationPoint point_;
  double sigma_m_;
};

}  // namespace trajlo
