// SPDX-License-Identifier: MIT
#include "core/odometry/window/segment_interval.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "core/odometry/window/window_statistics.h"

namespace trajlo {
namespace {

constexpr std::int64_t kMs = 1'000'000;

/// Control poses of `pose_at` (seconds), by turns 10, 30 and 20 ms apart.
Trajectory UnevenTrajectory(const std::function<SE3(double)>& pose_at, int end_ms) {
  Trajectory trajectory;
  const int steps_ms[] = {10, 30, 20};
  for (int t = 0, i = 0; t <= end_ms; t += steps_ms[i++ % 3]) {
    trajectory.Append({t * kMs, pose_at(1e-3 * t), 0});
  }
  return trajectory;
}

TEST(MeasureAcceleration, AConstantTurnOnACircleIsNoAcceleration) {
  Vector6d twist;
  twist << 2.0, 0.0, 0.3, 0.0, 0.5, 6.0;
  const Trajectory circle = UnevenTrajectory([&](double t) { return se3::Exp(t * twist); }, 300);
  const auto acceleration = MeasureAcceleration(circle, 0.06, 5.0);
  ASSERT_TRUE(acceleration);
  EXPECT_NEAR(*acceleration, 0.0, 1e-9);
}

TEST(MeasureAcceleration, AddsAngularAccelerationAtTheLeverArmToTheLinearOne) {
  const auto pose_at = [](double t) {
    return SE3(so3::Exp({0.5 * 8.0 * t * t, 0.0, 0.0}), {0.5 * 3.0 * t * t, 0.0, 0.0});
  };
  Trajectory even;
  for (int t = 0; t <= 300; t += 30) even.Append({t * kMs, pose_at(1e-3 * t), 0});
  const auto acceleration = MeasureAcceleration(even, 0.09, 5.0);
  ASSERT_TRUE(acceleration);
  EXPECT_NEAR(*acceleration, 3.0 + 5.0 * 8.0, 1e-6);
}

TEST(MeasureAcceleration, IsUnknownWhileTheTrajectoryIsShort) {
  const auto rest = [](double) { return SE3(); };
  EXPECT_FALSE(MeasureAcceleration({}, 0.06, 5.0));
  EXPECT_FALSE(MeasureAcceleration(UnevenTrajectory(rest, 100), 0.06, 5.0));
  EXPECT_TRUE(MeasureAcceleration(UnevenTrajectory(rest, 120), 0.06, 5.0));
}

TEST(MeasureAcceleration, IsUnknownIfTheNewestWindowDidNotConverge) {
  const auto measure = [](unsigned flags) {
    Trajectory trajectory;
    for (int t = 0; t < 300; t += 30) trajectory.Append({t * kMs, SE3(), 0});
    trajectory.Append({300 * kMs, SE3(), flags});
    return MeasureAcceleration(trajectory, 0.09, 5.0);
  };
  EXPECT_TRUE(measure(0));
  EXPECT_TRUE(measure(kFlagNoPoints));
  EXPECT_FALSE(measure(kFlagNotConverged));
  EXPECT_FALSE(measure(kFlagReverted));
}

AdaptiveIntervalOptions PlainOptions() {
  AdaptiveIntervalOptions options;
  options.divisions = 6;
  options.max_deviation_m = 0.01;
  options.reserve = 1.0;
  return options;
}

TEST(ChooseSlots, TakesTheLongestSegmentWithinTheBound) {
  const AdaptiveIntervalOptions options = PlainOptions();
  const double slot_s = 0.01;
  for (double acceleration = 1.0; acceleration < 2000.0; acceleration *= 1.3) {
    const auto holds = [&](int slots) {
      const double interval_s = slots * slot_s;
      return acceleration * interval_s * interval_s / 8.0 <= 0.01;
    };
    const int slots = ChooseSlots(options, slot_s, acceleration, 3);
    EXPECT_TRUE(slots == 1 || holds(slots));
    EXPECT_TRUE(slots == 6 || !holds(slots + 1));
  }
}

TEST(ChooseSlots, GrowsOnlyWithAReserveAndShrinksWithoutOne) {
  AdaptiveIntervalOptions options = PlainOptions();
  options.reserve = 2.0;
  const double slot_s = 0.01;
  const double just_for_four = 8.0 * 0.01 / (0.04 * 0.04);  // Deviation of 0.01 m in 0.04 s.
  EXPECT_EQ(ChooseSlots(options, slot_s, 0.99 * just_for_four, 4), 4);
  EXPECT_EQ(ChooseSlots(options, slot_s, 1.01 * just_for_four, 4), 3);
  EXPECT_EQ(ChooseSlots(options, slot_s, 0.99 * just_for_four, 2), 2);
  EXPECT_EQ(ChooseSlots(options, slot_s, 0.49 * just_for_four, 2), 4);
}

/// Feeds the interval with segments of its own choice, and says how many slots each had.
std::vector<int> Follow(const std::function<SE3(double)>& pose_at, double end_s) {
  AdaptiveIntervalOptions options;
  options.enabled = true;
  SegmentInterval interval(options, 0.03);
  Trajectory trajectory;
  trajectory.Append({0, pose_at(0.0), 0});
  std::vector<int> slots;
  for (std::int64_t t_ns = 0; 1e-9 * static_cast<double>(t_ns) < end_s;) {
    slots.push_back(interval.slots());
    t_ns += interval.slots() * 10 * kMs;
    trajectory.Append({t_ns, pose_at(1e-9 * static_cast<double>(t_ns)), 0});
    interval.Update(trajectory, 0.01 * interval.slots());
  }
  return slots;
}

TEST(SegmentInterval, StaysLongAtRestAndAtConstantSpeed) {
  const auto drive = [](double t) { return SE3(Eigen::Quaterniond::Identity(), {30.0 * t, 0, 0}); };
  for (const int slots : Follow(drive, 2.0)) EXPECT_EQ(slots, 3);
}

TEST(SegmentInterval, ShortensWhileTheSensorIsShakenAndGrowsBackAfterwards) {
  const auto shaken = [](double t) {
    const double s = std::clamp(t - 1.0, 0.0, 1.0);
    return SE3(so3::Exp({0.0, 0.3 * (1.0 - std::cos(8.0 * M_PI * s)), 0.0}), {0, 0, 0});
  };
  const std::vector<int> slots = Follow(shaken, 4.0);
  double t = 0.0;
  int shortest = 3;
  for (const int n : slots) {
    if (t < 1.0) {
      EXPECT_EQ(n, 3) << t;
    }
    shortest = std::min(shortest, n);
    t += 0.01 * n;
  }
  EXPECT_EQ(shortest, 1);
  EXPECT_EQ(slots.back(), 3);
}

}  // namespace
}  // namespace trajlo
