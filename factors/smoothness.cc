// SPDX-License-Identifier: MIT
#include "factors/smoothness.h"

#include "manifolds/se3_manifold.h"

namespace trajlo {

Vector6d SmoothnessTerm::Residual(const SE3& T_begin, const SE3& T_end) const {
  return sqrt_information.cwiseProduct(Minus(T_end, T_begin) - tau_expected);
}

SmoothnessTerm::Linearization SmoothnessTerm::Linearize(const SE3& T_begin,
                                                        const SE3& T_end) const {
  const Vector6d tau = Minus(T_end, T_begin);
  return {sqrt_information.cwiseProduct(tau - tau_expected),
          -(sqrt_information.asDiagonal() * se3::LeftJacobianInverse(tau)),
          sqrt_information.asDiagonal() * se3::RightJacobianInverse(tau)};
}

bool SmoothnessCost::Evaluate(double const* const* parameters, double* residuals,
                              double** jacobians) const {
  const SE3 T_begin = SE3::FromData(parameters[0]);
  const SE3 T_end = SE3::FromData(parameters[1]);
  Eigen::Map<Vector6d> r(residuals);
  if (jacobians == nullptr) {
    r = term_->Residual(T_begin, T_end);
    return true;
  }
  const SmoothnessTerm::Linearization linear = term_->Linearize(T_begin, T_end);
  r = linear.residual;
  using Jacobian = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;
  if (jacobians[0] != nullptr) {
    Eigen::Map<Jacobian> J(jacobians[0]);
    J.noalias() = linear.wrt_begin * Se3MinusJacobian(T_begin);
  }
  if (jacobians[1] != nullptr) {
    Eigen::Map<Jacobian> J(jacobians[1]);
    J.noalias() = linear.wrt_end * Se3MinusJacobian(T_end);
  }
  return true;
}

}  // namespace trajlo
