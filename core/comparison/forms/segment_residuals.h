// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/cost_function.h>

#include <vector>

#include "factors/point_to_plane.h"
#include "factors/segment_registration.h"

namespace trajlo {

/// The registration of a whole segment as one block with one residual a point, for comparison with
/// the condensed SegmentRegistrationCost: the same cost and gradient, each residual carrying its
/// robust kernel inside,
///
///   r~_i = sign(r_i) sqrt(rho(r_i²)),   dr~_i = rho'(r_i²) |r_i| / sqrt(rho(r_i²)) dr_i,
///
/// with r_i as at PointToPlaneCost. Its Gauss-Newton Hessian is that of the root of the kernel:
/// equal to the condensed one without a kernel, smaller with one. Parameter blocks: T_begin, T_end.
class SegmentResidualsCost final : public ceres::CostFunction {
 public:
  /// `points` must outlive the factor and stay as they are.
  SegmentResidualsCost(const std::vector<RegistrationPoint>* points,
                       const RegistrationNoise& noise);

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const std::vector<RegistrationPoint>* points_;
  RegistrationNoise noise_;
};

}  // namespace trajlo
