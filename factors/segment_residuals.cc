// SPDX-License-Identifier: MIT
#include "factors/segment_residuals.h"

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
  Eigen::Matrix<double, 6, 7> to_ambient[2];
  for (int block = 0; block < 2; ++block) to_ambient[block] = Se3MinusJacobian(poses[block]);
  Eigen::Matrix<double, 1, 12> wrt_poses;
  for (std::size_t i = 0; i < points_->size(); ++i) {
    const double r = EvaluatePointToPlane((*points_)[i], noise_.sigma_m, poses[0], poses[1],
                                          jacobians == nullptr ? nullptr : &wrt_poses);
    const RobustKernel::Value kernel = noise_.kernel.Evaluate(r * r);
    const double root = std::sqrt(kernel.rho);
    residuals[i] = std::copysign(root, r);
    if (jacobians == nullptr) continue;
    const double scale = root > 0.0 ? kernel.weight * std::abs(r) / root : 1.0;
    for (int block = 0; block < 2; ++block) {
      if (jacobians[block] == nullptr) continue;
      Eigen::Map<Eigen::Matrix<double, 1, 7, Eigen::RowMajor>> J(jacobians[block] + 7 * i);
      J.noalias() = scale * wrt_poses.segment<6>(6 * block) * to_ambient[block];
    }
  }
  return true;
}

}  // namespace trajlo
