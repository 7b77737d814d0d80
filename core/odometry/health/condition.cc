// SPDX-License-Identifier: MIT
#include "core/odometry/health/condition.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/odometry/window/point_scatter.h"
#include "core/odometry/window/rigid_motion.h"

namespace trajlo {
namespace {

constexpr double kSigmas = 3.0;

/// H and F of a rigid motion of the window, in the frame of its newest pose.
struct RigidInformation {
  Matrix6d H = Matrix6d::Zero();
  SpuriousInformation spurious;  ///< Its sums; the groups stay with the segments.
  double points = 0.0;

  explicit RigidInformation(const Window& window) {
    const SE3& newest = window.EndPose();
    for (int k = 0; k < window.size(); ++k) {
      const Segment& segment = window.At(k);
      const auto A = RigidMotionOfEnds(newest, window.Pose(k), window.Pose(k + 1));
      H += A.transpose() * segment.registration.H * A;
      const Matrix6d A_begin = A.topRows<6>();
      H -= A_begin.transpose() * segment.spurious.no_surface * A_begin;
      spurious.mean += A_begin.transpose() * segment.spurious.mean * A_begin;
      spurious.sum += segment.spurious.sum;
      spurious.sum_of_squares += segment.spurious.sum_of_squares;
      points += static_cast<double>(segment.points.size());
    }
  }
};

/// 1 + 3 sqrt(2 / N_F): the sum of N_F squares of Gaussian noise, in units of its mean. N_F is the
/// number of normals that are independent.
double LargestSpurious(const SpuriousInformation& spurious, double points_per_error) {
  if (!(spurious.sum > 0.0)) return 1.0;
  const double count = spurious.sum * spurious.sum / (points_per_error * spurious.sum_of_squares);
  return 1.0 + kSigmas * std::sqrt(2.0 / count);
}

/// s(u): how much the information about u, a rigid motion in the frame of the newest pose, would
/// differ with other places.
double SpreadOverPlaces(const Window& window, const Vector6d& u) {
  constexpr int kGroups = SpuriousInformation::kGroups;
  Eigen::Array<double, kGroups, 1> sums = Eigen::Array<double, kGroups, 1>::Zero();
  const SE3& newest = window.EndPose();
  for (int k = 0; k < window.size(); ++k) {
    const SpuriousInformation& spurious = window.At(k).spurious;
    const Vector6d u_begin = se3::Adjoint(window.Pose(k).Inverse() * newest) * u;
    for (int i = 0; i < kGroups; ++i) {
      sums[i] += u_begin.dot(spurious.by_place[static_cast<std::size_t>(i)] * u_begin);
    }
  }
  return std::sqrt((sums - sums.mean()).square().sum() * kGroups / (kGroups - 1.0));
}

}  // namespace

WindowCondition ConditionOf(const Window& window, const RegistrationOptions& registration) {
  const double points_per_error = registration.points_per_error;
  const RigidInformation information(window);
  WindowCondition condition;
  const double translation = information.H.topLeftCorner<3, 3>().trace();
  const double rotation = information.H.bottomRightCorner<3, 3>().trace();
  if (!(translation > 0.0) || !(rotation > 0.0)) return condition;
  Vector6d scaling = Vector6d::Ones();
  scaling.tail<3>().setConstant(std::sqrt(translation / rotation));
  const Matrix6d certain = information.H - LargestSpurious(information.spurious, points_per_error) *
                                               information.spurious.mean;
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(scaling.asDiagonal() * certain *
                                                      scaling.asDiagonal());
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 6; ++i) {
    const Vector6d direction = eigen.eigenvectors().col(i);
    const double spread = SpreadOverPlaces(window, scaling.cwiseProduct(direction));
    const double sure = eigen.eigenvalues()[i] - kSigmas * spread;
    if (sure >= least) continue;
    least = sure;
    condition.weak_direction = direction;
  }
  const double left_over = 1.0 - 6.0 * points_per_error / information.points;
  const double scatter_m = std::max(PointScatter(window), registration.sigma_m);
  condition.smallest_eigenvalue = std::max(0.0, left_over) * std::max(0.0, least) *
                                  std::pow(registration.sigma_m / scatter_m, 2);
  return condition;
}

}  // namespace trajlo
