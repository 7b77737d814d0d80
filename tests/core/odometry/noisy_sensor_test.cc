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

/// Only walls are seen, which leave the height open. Planes of noise held it where it was, while
/// the body rose: 0.7 m off after ten seconds, and no flag said so.
TEST_P(NoisySensor, IsToldThatWallsLeaveTheHeightOpen) {
  simulation::Scenario scenario = simulation::MakeScenario("atrium_os1_16");
  scenario.duration_s = 10.0;
  scenario.seed = GetParam();
  scenario.rig[0].measurement.range_sigma_m = 0.1;
  const testing::SimulatedRun run(scenario);
  std::size_t off = 0, told = 0;
  for (std::size_t i = 30; i < run.poses.size(); ++i) {
    const SE3 moved = run.poses[i - 30].T_world_body.Inverse() * run.poses[i].T_world_body;
    const SE3 truth = run.truth[i - 30].Inverse() * run.truth[i];
    if ((moved.t - truth.t).norm() < 0.2) continue;
    ++off;
    for (std::size_t k = i - 30; k <= i; ++k) {
      if (run.poses[k].flags == 0) continue;
      ++told;
      break;
    }
  }
  EXPECT_EQ(told, off);
}

INSTANTIATE_TEST_SUITE_P(Seeds, NoisySensor, ::testing::Values(1, 2));

}  // namespace
}  // namespace trajlo
