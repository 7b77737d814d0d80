// SPDX-License-Identifier: MIT
#include "factors/marginalization_prior.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "factors/square_root.h"
#include "manifolds/se3_manifold.h"

namespace trajlo {

Matrix6d MarginalizationPrior::Jacobian(const SE3& pose, bool first_estimate) const {
  if (first_estimate) return sqrt_information;
  return sqrt_information * se3::RightJacobianInverse(Minus(pose, linearization_point));
}

MarginalizationPrior MakeAnchor(const SE3& pose, double sigma_translation_m,
                                double sigma_rotation_rad) {
  MarginalizationPrior prior;
  prior.linearization_point = pose;
  prior.sqrt_information.diagonal().head<3>().setConstant(1.0 / sigma_translation_m);
  prior.sqrt_information.diagonal().tail<3>().setConstant(1.0 / sigma_rotation_rad);
  return prior;
}

MarginalizationPrior MarginalizeSchur(const Matrix12d& H, const Vector12d& g,
                                      const SE3& linearization_point) {
  const Matrix6d H_ll = H.topLeftCorner<6, 6>();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(H_ll);
  const Vector6d values = eigen.eigenvalues();
  const double smallest = 1e-14 * std::max(values.maxCoeff(), 0.0);
  const Vector6d inverse =
      values.unaryExpr([smallest](double v) { return v > smallest ? 1.0 / v : 0.0; });
  const Matrix6d H_ll_inverse =
      eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
  const Matrix6d gain = H.bottomLeftCorner<6, 6>() * H_ll_inverse;
  Matrix6d H_m = H.bottomRightCorner<6, 6>() - gain * H.topRightCorner<6, 6>();
  H_m = 0.5 * (H_m + H_m.transpose().eval());
  const Vector6d b_m = g.tail<6>() - gain * g.head<6>();
  const SquareRoot<6> root = MakeSquareRoot<6>(H_m, b_m);
  return {linearization_point, root.S, root.s};
}

MarginalizationPrior MarginalizeQr(const Eigen::Matrix<double, Eigen::Dynamic, 12>& jacobian,
                                   const Eigen::VectorXd& residual,
                                   const SE3& linearization_point) {
  Eigen::MatrixXd stacked = Eigen::MatrixXd::Zero(std::max<Eigen::Index>(jacobian.rows(), 13), 13);
  stacked.topLeftCorner(jacobian.rows(), 12) = jacobian;
  stacked.topRightCorner(jacobian.rows(), 1) = residual;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(stacked);
  const Eigen::MatrixXd R = qr.matrixQR().triangularView<Eigen::Upper>();
  MarginalizationPrior prior;
  prior.linearization_point = linearization_point;
  prior.sqrt_information = R.block<6, 6>(6, 6);
  prior.offset = R.block<6, 1>(6, 12);
  return prior;
}

bool MarginalizationPriorCost::Evaluate(double const* const* parameters, double* residuals,
                                        double** jacobians) const {
  const SE3 pose = SE3::FromData(parameters[0]);
  Eigen::Map<Vector6d> r(residuals);
  r = prior_.Residual(pose);
  if (jacobians != nullptr && jacobians[0] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> J(jacobians[0]);
    J.noalias() = prior_.Jacobian(pose, first_estimate_jacobians_) * Se3MinusJacobian(pose);
  }
  return true;
}

}  // namespace trajlo
