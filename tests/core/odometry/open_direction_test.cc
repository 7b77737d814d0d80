// SPDX-License-Identifier: MIT
// A direction that points leave open for seconds is flagged, and no more: the map grows on, and a
// run that is right is not lost.
#include <gtest/gtest.h>

#include "tests/support/simulated_run.h"

namespace trajlo {
namespace {

TEST(OpenDirection, DoesNotTakeAFastCarOutOfItsMap) {
  simulation::Scenario scenario = simulation::MakeScenario("motorway_hdl64");
  scenario.duration_s = 6.0;
  scenario.seed = 5577;
  scenario.rig[0].columns = 512;
  const testing::SimulatedRun run(scenario);
  EXPECT_FALSE(run.lost_at_ns);
  EXPECT_LT(run.LargestError_m(), 0.5);
}

TEST(OpenDirection, IsNoLossWhereQuickLooksLeaveWindowsUnsettled) {
  simulation::Scenario scenario = simulation::MakeScenario("corridor_glances_vlp16");
  scenario.duration_s = 8.0;
  scenario.seed = 32;
  const testing::SimulatedRun run(scenario);
  EXPECT_FALSE(run.lost_at_ns);
  EXPECT_LT(run.LargestError_m(), 0.2);
}

/// Swung on a rope, beyond 3 g: for a quarter of a second only the floor is in view.
class OnlyTheFloor : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(OnlyTheFloor, TheBodyThatTurnedOnItUnseenIsFoundAgain) {
  simulation::Scenario scenario = simulation::MakeScenario("swing_avia");
  scenario.duration_s = 5.6;  // The walls are back from 4.8 to 5.8 s.
  scenario.seed = GetParam();
  const testing::SimulatedRun run(scenario);
  EXPECT_FALSE(run.lost_at_ns);
  EXPECT_LT((run.poses.back().T_world_body.t - run.truth.back().t).norm(), 0.2);
}

INSTANTIATE_TEST_SUITE_P(Seeds, OnlyTheFloor, ::testing::Values(20, 26, 28, 43));

}  // namespace
}  // namespace trajlo
