// SPDX-License-Identifier: MIT
#include "core/odometry/window/covariance.h"

#include <Eigen/Cholesky>
#include <limits>

namespace trajlo {

Matrix6d PoseCovariance(const WindowNormalEquations& window, int k) {
  const Eigen::LDLT<Eigen::MatrixXd> ldlt(window.H);
  const Eigen::VectorXd pivots = ldlt.vectorD();
  if (ldlt.info() != Eigen::Success || !(pivots.minCoeff() > 1e-14 * pivots.maxCoeff())) {
    return Matrix6d::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(window.H.rows(), 6);
  unit.middleRows<6>(6 * k).setIdentity();
  const Matrix6d covariance = ldlt.solve(unit).middleRows<6>(6 * k);
  return 0.5 * (covariance + covariance.transpose());
}

}  // namespace trajlo
