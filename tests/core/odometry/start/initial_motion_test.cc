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

InitialMotion Estimate(const SegmentCloud& cloud) {
  ThreadPool threads(1);
  return EstimateInitialMotion(cloud, {}, {}, &threads);
}

TEST(InitialMotion, FindsAConstantTwist) {
  for (const auto& [forward_m_s, yaw_rad_s] :
       {std::pair(1.5, 0.0), std::pair(0.0, 0.6), std::pair(1.0, -0.4), std::pair(3.0, 0.3)}) {
    const Vector6d twist = Twist(forward_m_s, yaw_rad_s);
    const InitialMotion motion = Estimate(FirstInterval(twist));
    EXPECT_LT((motion.tau - kInterval_s * twist).head<3>().norm(), 0.05) << forward_m_s;
    EXPECT_LT((motion.tau - kInterval_s * twist).tail<3>().norm(), 0.01) << yaw_rad_s;
    EXPECT_GT(motion.found.agreeing, motion.at_rest.agreeing);
  }
}

TEST(InitialMotion, AtRestIsTakenForRest) {
  ThreadPool threads(1);
  const SegmentCloud cloud = FirstInterval(Vector6d::Zero());
  const FirstMotion motion = MotionOfFirstInterval(cloud, {}, {}, {}, &threads);
  EXPECT_EQ(motion.velocity, Vector6d(Vector6d::Zero()));
  EXPECT_TRUE(motion.is_at_rest);
  EXPECT_TRUE(motion.is_steady);
}

TEST(InitialMotion, ATurnToAndFroIsNotSteady) {
  const auto motion_of = [](const SegmentCloud& cloud) {
    ThreadPool threads(1);
    return MotionOfFirstInterval(cloud, {}, {}, {}, &threads);
  };
  const FirstMotion walk = motion_of(FirstInterval(Twist(1.5, 0.6)));
  EXPECT_TRUE(walk.is_steady);
  EXPECT_FALSE(walk.is_at_rest);
  EXPECT_FALSE(motion_of(FirstInterval([](double t_s) {
                 Vector6d tau = t_s * Twist(1.5, 0.0);
                 tau[4] = 0.15 * std::sin(2.0 * M_PI * 2.5 * t_s);
                 return se3::Exp(tau);
               })).is_steady);
}

TEST(InitialMotion, IsNotLookedForWhereItIsSwitchedOff) {
  ThreadPool threads(1);
  InitializationOptions options;
  options.estimate_motion = false;
  const SegmentCloud cloud = FirstInterval(Twist(2.0, 0.0));
  EXPECT_EQ(MotionOfFirstInterval(cloud, options, {}, {}, &threads).velocity,
            Vector6d(Vector6d::Zero()));
  EXPECT_NEAR(MotionOfFirstInterval(cloud, {}, {}, {}, &threads).velocity[0], 2.0, 0.2);
}

TEST(InitialMotion, DoesNotDependOnThreads) {
  const SegmentCloud cloud = FirstInterval(Twist(1.0, 0.5));
  ThreadPool one(1), two(2);
  EXPECT_EQ(EstimateInitialMotion(cloud, {}, {}, &one).tau,
            EstimateInitialMotion(cloud, {}, {}, &two).tau);
}

TEST(InitialMotion, OfNothingIsNothing) {
  EXPECT_EQ(Estimate(SegmentCloud()).tau, Vector6d(Vector6d::Zero()));
}

}  // namespace
}  // namespace trajlo
