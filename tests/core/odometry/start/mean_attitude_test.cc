// SPDX-License-Identifier: MIT
#include "core/odometry/start/mean_attitude.h"

#include <gtest/gtest.h>

#include "manifolds/so3.h"

namespace trajlo {
namespace {

/// A body that turns about `vertical` and tilts now and then, mounted in any way.
MeanAttitude Carried(const Eigen::Vector3d& vertical, const Eigen::Quaterniond& mounting) {
  MeanAttitude attitude;
  for (int i = 0; i < 100; ++i) {
    const double tilt = 0.2 * std::sin(1.7 * i);
    const Eigen::Vector3d across = vertical.unitOrthogonal();
    attitude.Add(so3::Exp(0.05 * i * vertical) * so3::Exp(tilt * across) * mounting);
  }
  return attitude;
}

TEST(MeanAttitude, FindsTheAxisAboutWhichTheBodyTurns) {
  const Eigen::Vector3d vertical = Eigen::Vector3d(0.5, -0.2, 0.8).normalized();
  const Eigen::Quaterniond mounting = so3::Exp({0.3, 1.0, -0.4});
  const Eigen::Vector3d found = Carried(vertical, mounting).VerticalInWorld();
  EXPECT_GT(std::abs(found.dot(vertical)), 0.99);
}

TEST(MeanAttitude, IsZWhileNothingHasTurned) {
  MeanAttitude attitude;
  EXPECT_EQ(attitude.VerticalInWorld(), Eigen::Vector3d::UnitZ());
  for (int i = 0; i < 10; ++i) attitude.Add(Eigen::Quaterniond::Identity());
  EXPECT_NEAR(std::abs(attitude.VerticalInWorld().z()), 1.0, 1e-9);
}

TEST(MeanAttitude, TakesOffTiltAndLeavesTheHeading) {
  const MeanAttitude attitude = Carried(Eigen::Vector3d::UnitZ(), Eigen::Quaterniond::Identity());
  const Eigen::Quaterniond level = so3::Exp({0.0, 0.0, 1.2});
  const Eigen::Quaterniond tilted = level * so3::Exp({0.0, 0.4, 0.0});
  EXPECT_LT(attitude.Levelled(tilted).angularDistance(level), 0.1);
}

}  // namespace
}  // namespace trajlo
