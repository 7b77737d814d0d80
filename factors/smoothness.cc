// SPDX-License-Identifier: MIT
#include "factors/smoothness.h"

#include "manifolds/se3_manifold.h"

namespace trajlo {

Vector6d SmoothnessTerm::Residual(const SE3& T_begin, const SE3& T_end) const {
  return sqrt_information.cwiseProduct(Minus(T_end, T_begin) - tau_expected);
}

Eigen::Matrix<double, 6, 12> SmoothnessTerm::Jacobian(const SE3& T_begin, const SE3& T_end) const {
  const Vector6d tau = Minus(T_end, T_begin);
  Eigen::Matrix<double, 6, 12> J;
  J << -se3::LeftJacobianInverse(tau), se3::RightJacobianInverse(tau);
  return sqrt_information.asDiagonal() * J;
}

bool SmoothnessCost::Evaluate(double const* const* parameters, double* residuals,
                              double** jacobians) const {
  const SE3 T[2] = {SE3::FromData(parameters[0]), SE3::FromData(parameters[1])};
  Eigen::Map<Vector6d> r(residuals);
  r = term_->Residual(T[0], T[1]);
  if (jacobians != nullptr) WriteJacobians(T, term_->Jacobian(T[0], T[1]), jacobians);
  return true;
}

}  // namespace trajlo
