// SPDX-License-Identifier: MIT
#include "core/odometry/start/initial_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "core/odometry/segments/join_segments.h"
#include "core/odometry/segments/segmenter.h"
#include "tests/support/synthetic_world.h"

namespace trajlo {
namespace {

constexpr double kInterval_s = 0.3;
constexpr std::size_t kSegments = 10;  ///< Of 0.03 s.

/// The first interval of a body that moves like this.
SegmentCloud FirstInterval(const std::function<SE3(double t_s)>& T_world_body) {
  testing::SyntheticWorld world;
  world.T_world_body = T_world_body;
  Segmenter segmenter{SegmenterOptions()};
  for (int i = 0; i < 5; ++i) segmenter.AddScan(world.Sweep(i));
  std::vector<SegmentCloud> segments;
  while (segments.size() < kSegments) segments.push_back(segmenter.Next().value());
  return JoinSegments(segments);
}

/// By a constant twist.
SegmentCloud FirstInterval(const Vector6d& twist_per_s) {
  return FirstInterval([&](double t_s) { return se3::Exp(t_s * twist_per_s); });
}

Vector6d Twist(double forward_m_s, double yaw_rad_s) {
  Vector6d twist = Vector6d::Zero();
  twist[0] = forward_m_s;
  twist[5] = yaw_rad_s;
  return twist;
}

FirstMotion MotionOf(const SegmentCloud& cloud, const OdometryOptions& options = {},
                     int threads = 1) {
  ThreadPool pool(threads);
  return MotionOfFirstInterval(cloud, options, &pool);
}

TEST(InitialMotion, FindsAConstantTwist) {
  for (const auto& [forward_m_s, yaw_rad_s] :
       {std::pair(1.5, 0.0), std::pair(0.0, 0.6), std::pair(1.0, -0.4), std::pair(3.0, 0.3)}) {
    const Vector6d twist = Twist(forward_m_s, yaw_rad_s);
    const FirstMotion motion = MotionOf(FirstInterval(twist));
    const Vector6d error = kInterval_s * (motion.velocity - twist);
    EXPECT_LT(error.head<3>().norm(), 0.05) << forward_m_s;
    EXPECT_LT(error.tail<3>().norm(), 0.01) << yaw_rad_s;
    EXPECT_FALSE(motion.is_at_rest);
  }
}

TEST(InitialMotion, AtRestIsTakenForRest) {
  const FirstMotion motion = MotionOf(FirstInterval(Vector6d::Zero()));
  EXPECT_EQ(motion.velocity, Vector6d(Vector6d::Zero()));
  EXPECT_TRUE(motion.is_at_rest);
  EXPECT_TRUE(motion.is_steady);
}

TEST(InitialMotion, ATurnToAndFroIsNotSteady) {
  const FirstMotion walk = MotionOf(FirstInterval(Twist(1.5, 0.6)));
  EXPECT_TRUE(walk.is_steady);
  EXPECT_FALSE(walk.is_at_rest);
  EXPECT_FALSE(MotionOf(FirstInterval([](double t_s) {
                 Vector6d tau = t_s * Twist(1.5, 0.0);
                 tau[4] = 0.15 * std::sin(2.0 * M_PI * 2.5 * t_s);
                 return se3::Exp(tau);
               })).is_steady);
}

TEST(InitialMotion, IsNotLookedForWhereItIsSwitchedOff) {
  OdometryOptions options;
  options.initialization.estimate_motion = false;
  const SegmentCloud cloud = FirstInterval(Twist(2.0, 0.0));
  EXPECT_EQ(MotionOf(cloud, options).velocity, Vector6d(Vector6d::Zero()));
  EXPECT_NEAR(MotionOf(cloud).velocity[0], 2.0, 0.2);
}

TEST(InitialMotion, DoesNotDependOnThreads) {
  const SegmentCloud cloud = FirstInterval(Twist(1.0, 0.5));
  EXPECT_EQ(MotionOf(cloud, {}, 1).velocity, MotionOf(cloud, {}, 2).velocity);
}

TEST(InitialMotion, OfNothingIsNothing) {
  SegmentCloud nothing;
  EXPECT_EQ(MotionOf(nothing).velocity, Vector6d(Vector6d::Zero()));
  nothing.end_ns = 300'000'000;
  EXPECT_EQ(MotionOf(nothing).velocity, Vector6d(Vector6d::Zero()));
  EXPECT_FALSE(MotionOf(nothing).is_shown);
}

}  // namespace
}  // namespace trajlo
