// SPDX-License-Identifier: MIT
#include "core/odometry/health/condition.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace trajlo {

WindowCondition ConditionOf(const Window& window) {
  const SE3& newest = window.Pose(window.size());
  Matrix6d information = Matrix6d::Zero();
  std::size_t points = 0;
  for (int k = 0; k < window.size(); ++k) {
    const Segment& segment = window.segments[static_cast<std::size_t>(k)];
    // A rigid motion xi of the newest frame moves T_j by Adj(T_j⁻¹ T_newest) xi.
    Eigen::Matrix<double, 12, 6> A;
    A << se3::Adjoint(window.Pose(k).Inverse() * newest),
        se3::Adjoint(window.Pose(k + 1).Inverse() * newest);
    information += A.transpose() * segment.registration.H * A;
    points += segment.points.size();
  }
  WindowCondition condition;
  const double translation = information.topLeftCorner<3, 3>().trace();
  const double rotation = information.bottomRightCorner<3, 3>().trace();
  if (points == 0 || !(translation > 0.0) || !(rotation > 0.0)) return condition;
  Vector6d scaling = Vector6d::Ones();
  scaling.tail<3>().setConstant(std::sqrt(translation / rotation));
  information = scaling.asDiagonal() * information * scaling.asDiagonal();
  information *= window.noise.sigma_m * window.noise.sigma_m / static_cast<double>(points);
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(information);
  condition.smallest_eigenvalue = eigen.eigenvalues()[0];
  condition.weak_direction = eigen.eigenvectors().col(0);
  return condition;
}

}  // namespace trajlo
