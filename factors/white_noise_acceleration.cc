// SPDX-License-Identifier: MIT
#include "factors/white_noise_acceleration.h"

#include "manifolds/se3_manifold.h"

namespace trajlo {

WhiteNoiseAccelerationTerm::WhiteNoiseAccelerationTerm(const Vector6d& density, double delta_1_s,
                                                       double delta_2_s)
    : first_s(delta_1_s),
      second_s(delta_2_s),
      sqrt_information((density * ((delta_1_s + delta_2_s) / 3.0)).cwiseSqrt().cwiseInverse()) {}

Vector6d WhiteNoiseAccelerationTerm::Residual(const SE3& T_0, const SE3& T_1,
                                              const SE3& T_2) const {
  const Vector6d before = Minus(T_1, T_0) / first_s - mean_velocity;
  const Vector6d after = Minus(T_2, T_1) / second_s - mean_velocity;
  return sqrt_information.cwiseProduct(after - persistence.cwiseProduct(before));
}

Eigen::Matrix<double, 6, 18> WhiteNoiseAccelerationTerm::Jacobian(const SE3& T_0, const SE3& T_1,
                                                                  const SE3& T_2) const {
  const Vector6d tau_1 = Minus(T_1, T_0);
  const Vector6d tau_2 = Minus(T_2, T_1);
  Eigen::Matrix<double, 6, 18> J;
  J << persistence.asDiagonal() * se3::LeftJacobianInverse(tau_1) / first_s,
      -se3::LeftJacobianInverse(tau_2) / second_s -
          persistence.asDiagonal() * se3::RightJacobianInverse(tau_1) / first_s,
      se3::RightJacobianInverse(tau_2) / second_s;
  return sqrt_information.asDiagonal() * J;
}

bool WhiteNoiseAccelerationCost::Evaluate(double const* const* parameters, double* residuals,
                                          double** jacobians) const {
  const SE3 T[3] = {SE3::FromData(parameters[0]), SE3::FromData(parameters[1]),
                    SE3::FromData(parameters[2])};
  Eigen::Map<Vector6d> r(residuals);
  r = term_->Residual(T[0], T[1], T[2]);
  if (jacobians != nullptr) WriteJacobians(T, term_->Jacobian(T[0], T[1], T[2]), jacobians);
  return true;
}

}  // namespace trajlo
