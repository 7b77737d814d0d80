// SPDX-License-Identifier: MIT
#include "core/comparison/forms/segment_residuals.h"

#include <cmath>

#include "manifolds/se3_manifold.h"

namespace trajlo {

SegmentResidualsCost::SegmentResidualsCost(const std::vector<RegistrationPoint>* points,
                                           const RegistrationNoise& noise)
    : points_(points), noise_(noise) {
  set_num_residuals(static_cast<int>(points->size()));
  *mutable_parameter_block_sizes() = {7, 7};
}

bool SegmentResidualsCost::Evaluate(double const* const* parameters, double* residuals,
                                    double** jacobians) const {
  const SE3 poses[2] = {SE3::FromData(parameters[0]), SE3::FromData(parameters[1])};
  Eigen::Matrix<double, Eigen::Dynamic, 12> J(jacobians == nullptr ? 0 : num_residuals(), 12);
  Eigen::Matrix<double, 1, 12> wrt_poses;
  for (int i = 0; i < num_residuals(); ++i) {
    const RegistrationPoint& point = (*points_)[static_cast<std::size_t>(i)];
    const double r = EvaluatePointToPlane(point, noise_.sigma_m, poses[0], poses[1],
                                          jacobians == nullptr ? nullptr : &wrt_poses);
    const RobustKernel kernel = noise_.KernelOf(point.axis);
    const double root = std::sqrt(kernel.Rho(r * r));
    residuals[i] = std::copysign(root, r);
    if (jacobians == nullptr) continue;
    const double scale = root > 0.0 ? kernel.Weight(r * r) * std::abs(r) / root : 1.0;
    J.row(i) = scale * wrt_poses;
  }
  if (jacobians != nullptr) WriteJacobians(poses, J, jacobians);
  return true;
}

}  // namespace trajlo
