// SPDX-License-Identifier: MIT
#include "core/odometry/weights/velocity_persistence.h"

#include <algorithm>
#include <cmath>

namespace trajlo {
namespace {

/// L.
constexpr double kLag_s = 0.3;
/// Over which m is the mean: longer than most swings take, shorter than a car accelerates.
constexpr double kMeanMemory_s = 2.0;
/// Over which the correlation is averaged.
constexpr double kMemory_s = 3.0;
/// c = kSlow_m_s².
constexpr double kSlow_m_s = 0.5;
/// What swings to and fro is not predicted to swing back.
constexpr double kLeast = 0.05;

}  // namespace

void VelocityPersistence::Learn(const Vector6d& velocity, const Vector6d& gain, double duration_s) {
  // Of what was seen so far, however little that is.
  const double mean_share = 1.0 - std::exp(-duration_s / kMeanMemory_s);
  mean_weight_ += mean_share * (1.0 - mean_weight_);
  mean_.head<3>() += mean_share / mean_weight_ * (velocity - mean_).head<3>();
  now_s_ += duration_s;
  past_.push_back({now_s_, (velocity - mean_).head<3>(), gain.head<3>().cwiseMax(0.0)});
  while (past_.size() > 1 && past_[1].end_s <= now_s_ - kLag_s) past_.pop_front();
  const Past &before = past_.front(), &now = past_.back();
  if (before.end_s > now_s_ - kLag_s) return;  // It has just begun.
  const Eigen::Vector3d weights = before.gain.cwiseProduct(now.gain);
  const double share = 1.0 - std::exp(-duration_s / kMemory_s);
  product_ += share * (weights.cwiseProduct(before.velocity).dot(now.velocity) - product_);
  square_ += share * (weights.dot(before.velocity.cwiseAbs2()) - square_);
}

double VelocityPersistence::share() const {
  constexpr double kEvidence = kSlow_m_s * kSlow_m_s;
  return std::clamp((product_ + kEvidence) / (square_ + kEvidence), kLeast, 1.0);
}

Vector6d VelocityPersistence::Over(double duration_s) const {
  Vector6d over = Vector6d::Ones();
  over.head<3>().setConstant(std::pow(share(), duration_s / kLag_s));
  return over;
}

}  // namespace trajlo
