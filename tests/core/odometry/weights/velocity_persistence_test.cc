// SPDX-License-Identifier: MIT
#include "core/odometry/weights/velocity_persistence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

constexpr double kStep_s = 0.03;

/// What is left after 0.3 s of a body that has moved along x at this speed.
double LeftAfter(double duration_s, const std::function<double(double)>& speed_at,
                 double gain = 0.9) {
  VelocityPersistence persistence;
  for (int i = 0; i * kStep_s < duration_s; ++i) {
    Vector6d velocity = Vector6d::Zero();
    velocity[0] = speed_at(i * kStep_s);
    persistence.Learn(velocity, Vector6d::Constant(gain), kStep_s);
  }
  EXPECT_DOUBLE_EQ(persistence.Over(0.3)[0], persistence.share());
  return persistence.share();
}

TEST(VelocityPersistence, AllIsKeptUntilThereIsEvidence) {
  EXPECT_EQ(VelocityPersistence().Over(1.0), Vector6d::Ones());
  EXPECT_EQ(VelocityPersistence().mean_velocity(), Vector6d::Zero());
  // A start in motion is no change of velocity.
  EXPECT_EQ(LeftAfter(5.0, [](double) { return 25.0; }), 1.0);
}

TEST(VelocityPersistence, AtRestVelocitiesAreNoise) {
  testing::Random random;
  EXPECT_GT(LeftAfter(20.0, [&](double) { return random.Gaussian(0.03); }), 0.99);
}

TEST(VelocityPersistence, ACarKeepsItsVelocity) {
  const auto from_rest = [](double t_s) { return 3.0 * std::max(0.0, t_s - 2.0); };
  for (const double t_s : {2.5, 3.0, 5.0, 12.0}) EXPECT_GT(LeftAfter(t_s, from_rest), 0.97) << t_s;
  const auto braking = [](double t_s) { return 25.0 - 6.0 * std::max(0.0, t_s - 2.0); };
  for (const double t_s : {2.5, 3.0, 5.0}) EXPECT_GT(LeftAfter(t_s, braking), 0.97) << t_s;
}

TEST(VelocityPersistence, AHandThatShakesDoesNot) {
  for (const double hertz : {0.8, 1.5, 2.5}) {
    const auto speed = [&](double t_s) { return 2.0 * std::sin(2.0 * M_PI * hertz * t_s); };
    EXPECT_LT(LeftAfter(5.0, speed), 0.35) << hertz;
    EXPECT_LT(LeftAfter(5.0, [&](double t_s) { return 10.0 + speed(t_s); }), 0.35) << hertz;
  }
}

TEST(VelocityPersistence, FindsTheShareOfARandomWalkThatReturns) {
  testing::Random random(3);
  for (const double time_s : {0.2, 1.0}) {
    const double share = std::exp(-kStep_s / time_s);
    double sum = 0.0;
    constexpr int kRuns = 30;
    for (int run = 0; run < kRuns; ++run) {
      double v = 0.0;
      sum += LeftAfter(10.0, [&](double) {
        return v = share * v + random.Gaussian(4.0 * std::sqrt(1.0 - share * share));
      });
    }
    // A mean over two seconds follows a slow one, and takes some of it away.
    EXPECT_NEAR(sum / kRuns, std::exp(-0.3 / time_s), 0.15) << time_s;
  }
}

TEST(VelocityPersistence, LearnsNothingWhereThePointsTellNothing) {
  const auto speed = [](double t_s) { return 2.0 * std::sin(10.0 * t_s); };
  EXPECT_EQ(LeftAfter(5.0, speed, 0.0), 1.0);
}

TEST(VelocityPersistence, IsAShareForEachTime) {
  VelocityPersistence persistence;
  for (int i = 0; i < 200; ++i) {
    Vector6d velocity = Vector6d::Zero();
    velocity[1] = 2.0 * std::sin(0.3 * i);
    velocity[5] = std::sin(0.3 * i);
    persistence.Learn(velocity, Vector6d::Ones(), kStep_s);
  }
  const Vector6d once = persistence.Over(0.05), twice = persistence.Over(0.1);
  EXPECT_LT(once[0], 1.0);
  EXPECT_NEAR(twice[0], once[0] * once[0], 1e-12);
  EXPECT_EQ(once.tail<3>(), Eigen::Vector3d::Ones());
  EXPECT_EQ(persistence.mean_velocity().tail<3>(), Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace trajlo
