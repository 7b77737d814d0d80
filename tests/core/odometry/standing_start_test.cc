// SPDX-License-Identifier: MIT
// A car that stands sees the same rings on the road over and over. With one point of a guard rail
// or of a passing car a ring makes a vertical plane, which moves along when the car leaves.
#include <gtest/gtest.h>

#include "tests/support/simulated_run.h"

namespace trajlo {
namespace {

class StandingStart : public ::testing::TestWithParam<std::uint64_t> {};

/// While such planes counted as thin, errors of more than 10 m.
TEST_P(StandingStart, IsFollowedOnAMotorway) {
  simulation::Scenario scenario = simulation::MakeScenario("motorway_start_os1_128");
  scenario.duration_s = 8.0;
  scenario.seed = GetParam();
  const testing::SimulatedRun run(scenario);
  EXPECT_FALSE(run.lost_at_ns);
  EXPECT_LT(run.LargestError_m(), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Seeds, StandingStart, ::testing::Values(1, 12));

}  // namespace
}  // namespace trajlo
