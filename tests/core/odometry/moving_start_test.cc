// SPDX-License-Identifier: MIT
// Recordings that begin in motion.
#include <gtest/gtest.h>

#include <optional>
#include <ostream>
#include <string>

#include "tests/support/simulated_run.h"

namespace trajlo {
namespace {

struct Start {
  std::string scenario;
  std::uint64_t seed;
  double shake = 1.0;
  std::optional<double> speed_m_s = {};  ///< Else the scenario's.
};
void PrintTo(const Start& start, std::ostream* os) {
  *os << start.scenario << " shake " << start.shake << " seed " << start.seed;
  if (start.speed_m_s) *os << " at " << *start.speed_m_s << " m/s";
}

simulation::Scenario ScenarioOf(const Start& start, double duration_s) {
  simulation::Scenario scenario = simulation::MakeScenario(start.scenario);
  scenario.motion.moving_start = true;
  scenario.motion.shake = start.shake;
  if (start.speed_m_s) scenario.motion.speed_mps = *start.speed_m_s;
  scenario.duration_s = duration_s;
  scenario.seed = start.seed;
  return scenario;
}

/// The road agrees with any speed, and the cars beside it with rest. The noise of the road's many
/// points must not hold the search where it starts. Where the body bounces, the rings of two sweeps
/// behind it seem to be walls, which agree with rest, too.
class OnAMotorway : public ::testing::TestWithParam<Start> {};

TEST_P(OnAMotorway, TheSpeedIsFound) {
  const testing::SimulatedRun run(ScenarioOf(GetParam(), 0.8));
  EXPECT_LT(run.LargestError_m(), 0.3);
}

INSTANTIATE_TEST_SUITE_P(MovingStart, OnAMotorway,
                         ::testing::Values(Start{"motorway_hdl64", 1}, Start{"motorway_hdl64", 4},
                                           Start{"motorway_hdl64", 5},
                                           Start{"motorway_hdl64", 3, 1.4},
                                           Start{"motorway_hdl64", 16, 1.4},
                                           Start{"motorway_hdl64", 3, 1.0, 27.0},
                                           Start{"motorway_hdl64", 5, 1.0, 33.0},
                                           Start{"motorway_hdl64", 3, 1.0, 20.0}));

/// A LiDAR that sees 60 m of the road has too little in view for the first 0.3 s to tell its speed.
TEST(MovingStart, WhatOneIntervalLeavesOpenIsFoundByFollowingForLonger) {
  simulation::Scenario scenario = ScenarioOf({"motorway_hdl64", 8, 1.0, 25.0}, 4.0);
  for (auto& lidar : scenario.rig) lidar.measurement.max_range_m = 60.0;
  EXPECT_LT(testing::SimulatedRun(scenario).LargestError_m(), 0.3);
}

/// Two LiDARs see a row of houses, which repeats itself: at a wrong speed, chance finds some of it
/// again.
TEST(MovingStart, ABodyAtRestBeforeARowOfHousesStaysThere) {
  for (const std::uint64_t seed : {5, 6}) {
    simulation::Scenario scenario = simulation::MakeScenario("long_facade_os1_16x2");
    scenario.duration_s = 3.5;
    scenario.seed = seed;
    EXPECT_LT(testing::SimulatedRun(scenario).LargestError_m(), 0.1) << "seed " << seed;
  }
}

/// A pause ends the search for the speed: what was seen until then decides. What comes behind it is
/// looked for in the map, and begins anew where that does not show it.
class PauseInTheSearch : public ::testing::TestWithParam<double> {};

TEST_P(PauseInTheSearch, LosesNoPosesAndFlagsThoseThatAreWrong) {
  constexpr double kPause_s = 1.2, kSweep_s = 0.1;
  const double from_s = GetParam(), end_s = from_s + kPause_s + 1.6;
  simulation::Scenario scenario = ScenarioOf({"motorway_hdl64", 8, 1.0, 25.0}, end_s);
  for (auto& lidar : scenario.rig) lidar.measurement.max_range_m = 60.0;
  scenario.faults.pause_from_s = from_s;
  scenario.faults.pause_s = kPause_s;
  const testing::SimulatedRun run(scenario);
  std::size_t behind = 0;
  for (std::size_t i = 1; i < run.poses.size(); ++i) {
    const double step_s = run.Time_s(i) - run.Time_s(i - 1);
    ASSERT_GT(step_s, 0.0);
    ASSERT_TRUE(run.poses[i].T_world_body.t.allFinite());
    const double error_m = (run.poses[i].T_world_body.t - run.truth[i].t).norm();
    if (run.poses[i].flags == 0U) {
      EXPECT_LT(error_m, 0.3) << run.Time_s(i);
    }
    if (step_s > kPause_s - kSweep_s) behind = i;
  }
  ASSERT_GT(behind, 0U);
  EXPECT_NE(run.poses[behind].flags & kFlagGap, 0U);
  EXPECT_GT(run.Time_s(behind - 1), from_s - kSweep_s);
  EXPECT_GT(run.Time_s(run.poses.size() - 1), end_s - 2.0 * kSweep_s);
}

INSTANTIATE_TEST_SUITE_P(MovingStart, PauseInTheSearch, ::testing::Values(1.0, 2.0));

/// In a flight with quick turns no constant twist explains the first 0.3 s.
class InAFlight : public ::testing::TestWithParam<Start> {};

TEST_P(InAFlight, TheFirstMapIsNotBlurred) {
  const testing::SimulatedRun run(ScenarioOf(GetParam(), 2.0));
  EXPECT_FALSE(run.lost_at_ns);
  // The first pose is the frame of all others: the motion since a later one is what counts.
  const std::size_t from = run.poses.size() / 4;
  const SE3 estimated = run.poses[from].T_world_body.Inverse() * run.poses.back().T_world_body;
  const SE3 error = (run.truth[from].Inverse() * run.truth.back()).Inverse() * estimated;
  EXPECT_LT(error.t.norm(), 0.15);
  EXPECT_LT(so3::Log(error.q).norm(), 0.03);
}

INSTANTIATE_TEST_SUITE_P(MovingStart, InAFlight,
                         ::testing::Values(Start{"courtyard_os1_16", 1},
                                           Start{"courtyard_os1_16", 3},
                                           Start{"hall_os1_16", 1, 2.0},
                                           Start{"hall_os1_16", 2, 2.0}, Start{"facade_os1_16", 2},
                                           Start{"facade_os1_16", 3}, Start{"atrium_os1_16", 2}));

/// The whole recording is shorter than the first interval. The two halves of one sweep see
/// different things, which agree with any motion that brings a few points together.
class ShortRecording : public ::testing::TestWithParam<Start> {};

TEST_P(ShortRecording, OfOneSweepTellsNoMotionAndSaysSo) {
  const testing::SimulatedRun run(ScenarioOf(GetParam(), 0.1));
  ASSERT_FALSE(run.poses.empty());
  for (const ControlPose& pose : run.poses) {
    EXPECT_NE(pose.flags & kFlagNoPoints, 0U);
    EXPECT_LT(pose.T_world_body.t.norm(), 0.1);
  }
}

TEST_P(ShortRecording, OfTwoSweepsMayTellItAndSaysThatNothingConfirmsIt) {
  const testing::SimulatedRun run(ScenarioOf(GetParam(), 0.2));
  ASSERT_FALSE(run.poses.empty());
  for (const ControlPose& pose : run.poses) EXPECT_NE(pose.flags & kFlagNoPoints, 0U);
  EXPECT_LT(run.LargestError_m(), 0.1);
}

INSTANTIATE_TEST_SUITE_P(MovingStart, ShortRecording,
                         ::testing::Values(Start{"street_hdl64", 1}, Start{"office_os0_64", 3}));

}  // namespace
}  // namespace trajlo
