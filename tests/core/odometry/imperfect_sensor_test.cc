// SPDX-License-Identifier: MIT
// Lasers as they are really calibrated: the rings that they draw on a road move along with the car,
// each at a height of its own, and nearly all points agree with a car that stands.
#include <gtest/gtest.h>

#include "tests/support/simulated_run.h"

namespace trajlo {
namespace {

class ImperfectSensor : public ::testing::TestWithParam<std::uint64_t> {};

/// With one kernel for all directions, position errors of 1.0 to 2.1 m RMSE (seeds 1 to 3).
TEST_P(ImperfectSensor, IsFollowedWhenACarLeavesAStop) {
  simulation::Scenario scenario = simulation::MakeScenario("motorway_jam_hdl64");
  scenario.duration_s = 6.0;
  scenario.seed = GetParam();
  simulation::MeasurementModel& model = scenario.rig[0].measurement;
  model.laser_range_sigma_m = 0.01;
  model.laser_angle_sigma_rad = 0.001;
  model.divergence_rad = 0.003;
  const testing::SimulatedRun run(scenario);
  EXPECT_FALSE(run.lost_at_ns);
  EXPECT_LT(run.LargestError_m(), 0.4);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ImperfectSensor, ::testing::Values(1, 3));

}  // namespace
}  // namespace trajlo
