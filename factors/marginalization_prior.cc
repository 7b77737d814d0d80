// SPDX-License-Identifier: MIT
#include "factors/marginalization_prior.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "factors/square_root.h"
#include "manifolds/se3_manifold.h"

namespace trajlo {
namespace {

Vector6d Difference(const MarginalizationPrior& prior, const std::vector<SE3>& s, int i) {
  return Minus(s[static_cast<std::size_t>(i)],
               prior.linearization_points[static_cast<std::size_t>(i)]);
}

}  // namespace

Eigen::VectorXd MarginalizationPrior::Residual(const std::vector<SE3>& s) const {
  Eigen::VectorXd r = offset;
  for (int i = 0; i < poses(); ++i) {
    r.noalias() += sqrt_information.middleCols<6>(6 * i) * Difference(*this, s, i);
  }
  return r;
}

Eigen::MatrixXd MarginalizationPrior::Jacobian(const std::vector<SE3>& s) const {
  Eigen::MatrixXd J = sqrt_information;
  for (int i = 0; i < poses() && !first_estimate_jacobians; ++i) {
    J.middleCols<6>(6 * i) =
        sqrt_information.middleCols<6>(6 * i) * se3::RightJacobianInverse(Difference(*this, s, i));
  }
  return J;
}

MarginalizationPrior MakeAnchor(const SE3& pose, double sigma_translation_m,
                                double sigma_rotation_rad) {
  MarginalizationPrior prior;
  prior.linearization_points = {pose};
  prior.offset = Eigen::VectorXd::Zero(6);
  prior.sqrt_information = Eigen::MatrixXd::Zero(6, 6);
  prior.sqrt_information.diagonal().head<3>().setConstant(1.0 / sigma_translation_m);
  prior.sqrt_information.diagonal().tail<3>().setConstant(1.0 / sigma_rotation_rad);
  return prior;
}

MarginalizationPrior MarginalizeSchur(const Eigen::MatrixXd& H, const Eigen::VectorXd& g,
                                      const std::vector<SE3>& staying) {
  const Matrix6d H_ll = H.topLeftCorner<6, 6>();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(H_ll);
  const Vector6d& values = eigen.eigenvalues();
  const double smallest = kNoInformation * std::max(values.maxCoeff(), 0.0);
  const Vector6d inverse =
      values.unaryExpr([smallest](double v) { return v > smallest ? 1.0 / v : 0.0; });
  const Matrix6d H_ll_inverse =
      eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
  const Eigen::Index rest = H.rows() - 6;
  const Eigen::MatrixXd gain = H.bottomLeftCorner(rest, 6) * H_ll_inverse;
  Eigen::MatrixXd H_m = H.bottomRightCorner(rest, rest) - gain * H.topRightCorner(6, rest);
  H_m = 0.5 * (H_m + H_m.transpose().eval());
  const Eigen::VectorXd b_m = g.tail(rest) - gain * g.head<6>();
  const auto root = MakeSquareRoot<Eigen::Dynamic>(H_m, b_m);
  return {staying, root.S, root.s};
}

MarginalizationPriorCost::MarginalizationPriorCost(const MarginalizationPrior* prior)
    : prior_(prior) {
  set_num_residuals(6 * prior->poses());
  mutable_parameter_block_sizes()->assign(static_cast<std::size_t>(prior->poses()), 7);
}

bool MarginalizationPriorCost::Evaluate(double const* const* parameters, double* residuals,
                                        double** jacobians) const {
  std::vector<SE3> s;
  s.reserve(static_cast<std::size_t>(prior_->poses()));
  for (int i = 0; i < prior_->poses(); ++i) s.push_back(SE3::FromData(parameters[i]));
  Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = prior_->Residual(s);
  if (jacobians != nullptr) WriteJacobians(s.data(), prior_->Jacobian(s), jacobians);
  return true;
}

}  // namespace trajlo
