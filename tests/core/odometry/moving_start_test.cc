// SPDX-License-Identifier: MIT
// A recording that begins at 30 m/s: the road agrees with any speed, and the cars beside it with
// rest.
#include <gtest/gtest.h>

#include "tests/support/simulated_run.h"

namespace trajlo {
namespace {

class MovingStart : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(MovingStart, OnAMotorwayIsFound) {
  simulation::Scenario scenario = simulation::MakeScenario("motorway_hdl64");
  scenario.duration_s = 0.8;
  scenario.seed = GetParam();
  const testing::SimulatedRun run(scenario);
  EXPECT_LT(run.LargestError_m(), 0.3);
}

INSTANTIATE_TEST_SUITE_P(Seeds, MovingStart, ::testing::Values(1, 4, 5));

}  // namespace
}  // namespace trajlo
