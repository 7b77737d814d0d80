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

}  // namespace
}  // namespace trajlo
