// SPDX-License-Identifier: MIT
#include "core/odometry/health/condition.h"

#include <gtest/gtest.h>

#include "core/odometry/health/belief.h"
#include "core/odometry/window/point_scatter.h"
#include "tests/support/test_window.h"

namespace trajlo {
namespace {

RegistrationOptions TenShareAnError() {
  RegistrationOptions registration;
  registration.points_per_error = 10.0;
  return registration;
}

TEST(WindowCondition, NamesTheDirectionThatNoPlaneHolds) {
  // A corridor along x: all normals are perpendicular to it.
  Window window = testing::MakeTestWindow(18);
  window.SetPoses(std::vector<SE3>(5));
  for (Segment& segment : window.segments) {
    for (RegistrationPoint& point : segment.points) {
      point.normal_world.x() = 0.0;
      point.normal_world.normalize();
    }
    segment.registration = LinearizeSegment(segment.points, SE3(), SE3(), window.noise);
  }
  const WindowCondition condition = ConditionOf(window, TenShareAnError());
  EXPECT_NEAR(condition.smallest_eigenvalue, 0.0, 1e-6);
  EXPECT_NEAR(std::abs(condition.weak_direction[0]), 1.0, 1e-6);
}

TEST(WindowCondition, PointsThatScatterFartherThanTheyWereTakenToTellLess) {
  Window window = testing::MakeTestWindow(18);
  for (Segment& segment : window.segments) {
    segment.registration = LinearizeSegment(segment.points, SE3(), SE3(), window.noise);
  }
  RegistrationOptions registration = TenShareAnError();
  const auto sure = [&](double sigmas) {
    registration.sigma_m = PointScatter(window) * sigmas;
    return ConditionOf(window, registration).smallest_eigenvalue;
  };
  ASSERT_GT(sure(1.0), 0.0);
  EXPECT_DOUBLE_EQ(sure(2.0), sure(1.0));
  EXPECT_NEAR(sure(0.5), sure(1.0) / 4, 1e-9 * sure(1.0));
}

TEST(WindowCondition, WithoutPointsOrLeverArmNothingIsHeldAndAllIsFinite) {
  const auto expect_nothing = [](const Window& window) {
    const WindowCondition condition = ConditionOf(window, TenShareAnError());
    EXPECT_EQ(condition.smallest_eigenvalue, 0.0);
    EXPECT_TRUE(condition.weak_direction.allFinite());
  };
  // No points at all, and points that are not registered.
  expect_nothing(testing::MakeTestWindow(18, 0));
  expect_nothing(testing::MakeTestWindow(18));
  // All points lie in the sensor's origin: nothing holds the rotations.
  Window window = testing::MakeTestWindow(18);
  window.SetPoses(std::vector<SE3>(5));
  for (Segment& segment : window.segments) {
    for (RegistrationPoint& point : segment.points) point.p_body_m.setZero();
    segment.registration = LinearizeSegment(segment.points, SE3(), SE3(), window.noise);
  }
  expect_nothing(window);
}

TEST(Belief, ANewestPoseFarFromItsPredictionIsNotBelieved) {
  const SE3 predicted = se3::Exp(Vector6d::Constant(0.7));
  const auto at = [&](double x_m, double yaw_rad) {
    Vector6d tau = Vector6d::Zero();
    tau[0] = x_m;
    tau[5] = yaw_rad;
    WindowStatistics statistics;
    statistics.correction = MeasureStep(predicted, predicted * se3::Exp(tau));
    return IsBelievable(statistics, Window());
  };
  EXPECT_TRUE(at(2.9, 0.0));
  EXPECT_FALSE(at(3.1, 0.0));
  EXPECT_TRUE(at(0.0, -0.95));
  EXPECT_FALSE(at(0.0, -1.05));
}

TEST(Belief, ARevertedWindowForgetsItsRegistration) {
  Window window = testing::MakeTestWindow(3);
  const std::vector<SE3> start(5);
  window.segments[1].registration.H.setIdentity();
  Revert(start, &window);
  EXPECT_EQ(window.segments[1].registration.H.norm(), 0.0);
  EXPECT_EQ(window.Pose(2).t.norm(), 0.0);
}

}  // namespace
}  // namespace trajlo
