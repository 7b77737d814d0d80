// SPDX-License-Identifier: MIT
#include "core/odometry/window/covariance.h"

#include <Eigen/Cholesky>
#include <limits>

#include "factors/square_root.h"

namespace trajlo {

Matrix6d PoseCovariance(const WindowNormalEquations& window, int k) {
  // With that pose last, its block of the factor L holds what is left when all others are
  // eliminated: the information L Lᵀ.
  Eigen::MatrixXd H = window.H;
  if (6 * (k + 1) < H.rows()) {
    H.middleRows<6>(6 * k).swap(H.bottomRows<6>());
    H.middleCols<6>(6 * k).swap(H.rightCols<6>());
  }
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(H);
  const Eigen::VectorXd pivots = H.diagonal().cwiseAbs2();
  if (factor.info() != Eigen::Success ||
      !(pivots.minCoeff() > kNoInformation * pivots.maxCoeff())) {
    return Matrix6d::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  const Matrix6d L = H.bottomRightCorner<6, 6>();
  const Matrix6d inverse = L.triangularView<Eigen::Lower>().solve(Matrix6d::Identity());
  return inverse.transpose() * inverse;
}

}  // namespace trajlo
