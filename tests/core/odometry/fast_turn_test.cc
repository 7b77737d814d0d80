// SPDX-License-Identifier: MIT
// A body that turns fast: a narrow view sees what the map does not have yet, and a turn that begins
// within a segment is nothing that the motion prior could foresee.
#include <gtest/gtest.h>

#include "tests/support/simulated_run.h"

namespace trajlo {
namespace {

using testing::SimulatedRun;

class FastTurn : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(FastTurn, IsFollowedIntoAPartOfTheWorldThatTheMapDoesNotHave) {
  simulation::Scenario scenario = simulation::MakeScenario("spin_fast_avia");
  scenario.duration_s = 4.0;  // The first turn at up to 35 rad/s ends at 2.7 s.
  scenario.seed = GetParam();
  const SimulatedRun run(scenario);
  EXPECT_FALSE(run.lost_at_ns);
  EXPECT_LT(run.LargestError_m(), 0.25);
}

INSTANTIATE_TEST_SUITE_P(Seeds, FastTurn, ::testing::Values(2, 4, 5, 6, 8));

class SuddenTurn : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(SuddenTurn, IsFollowedAfterACalmStretch) {
  simulation::Scenario scenario = simulation::MakeScenario("corridor_glances_vlp16");
  scenario.duration_s = 6.0;
  scenario.seed = GetParam();
  const SimulatedRun run(scenario);
  EXPECT_FALSE(run.lost_at_ns);
  EXPECT_LT(run.LargestError_m(), 0.06);
}

INSTANTIATE_TEST_SUITE_P(Seeds, SuddenTurn, ::testing::Values(2, 8, 16));

}  // namespace
}  // namespace trajlo
