// SPDX-License-Identifier: MIT
// Ranges that scatter nearly as far as the map's points are apart: around every place, a few of
// them make a plane that passes there, and hold the sensor where it is.
#include <gtest/gtest.h>

#include "tests/support/simulated_run.h"

namespace trajlo {
namespace {

class NoisySensor : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(NoisySensor, IsFollowed) {
  simulation::Scenario scenario = simulation::MakeScenario("courtyard_os1_16");
  scenario.duration_s = 8.0;
  scenario.seed = GetParam();
  scenario.rig[0].measurement.range_sigma_m = 0.1;
  const testing::SimulatedRun run(scenario);
  EXPECT_LT(run.LargestError_m(), 0.2);
}

INSTANTIATE_TEST_SUITE_P(Seeds, NoisySensor, ::testing::Values(1, 2));

}  // namespace
}  // namespace trajlo
