// SPDX-License-Identifier: MIT
#include "core/odometry/start/mean_attitude.h"

#include <Eigen/Eigenvalues>

namespace trajlo {
namespace {

/// How much z of the first pose counts, against 1 for a direction that never changed.
constexpr double kFirstVertical = 0.05;
/// A mean direction in the body frame says where up is if the directions were so much the same (1:
/// always).
constexpr double kSteady = 0.5;

}  // namespace

void MeanAttitude::Add(const Eigen::Quaterniond& q_world_body) {
  sum_ += q_world_body.toRotationMatrix();
  count_ += 1.0;
}

Eigen::Vector3d MeanAttitude::VerticalInWorld() const {
  if (count_ == 0.0) return Eigen::Vector3d::UnitZ();
  // |mean(R)ᵀ u| is 1 where Rᵀ u is always the same.
  const Eigen::Matrix3d mean = sum_ / count_;
  Eigen::Matrix3d sameness = mean * mean.transpose();
  sameness(2, 2) += kFirstVertical;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(sameness);
  return eigen.eigenvectors().col(2);
}

Eigen::Quaterniond MeanAttitude::Levelled(const Eigen::Quaterniond& q_world_body) const {
  const Eigen::Vector3d vertical_world = VerticalInWorld();
  const Eigen::Vector3d mean_in_body = sum_.transpose() * vertical_world;
  if (!(mean_in_body.norm() > kSteady * count_)) return q_world_body;
  const Eigen::Vector3d present = q_world_body * mean_in_body.normalized();
  return (Eigen::Quaterniond::FromTwoVectors(present, vertical_world) * q_world_body).normalized();
}

}  // namespace trajlo
