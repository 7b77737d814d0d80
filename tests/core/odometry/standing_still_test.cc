// SPDX-License-Identifier: MIT
// A body that stands still has no velocity, from the first interval on.
#include <gtest/gtest.h>

#include "tests/support/simulated_run.h"

namespace trajlo {
namespace {

using testing::SimulatedRun;

simulation::Scenario Still(const std::string& name, std::uint64_t seed) {
  simulation::Scenario scenario = simulation::MakeScenario(name);
  scenario.motion.kind = "still";
  scenario.duration_s = 2.0;
  scenario.seed = seed;
  return scenario;
}

/// The speed from pose to pose, at least `span_s` apart, that begin at `begin_s` or later.
double LargestMeanSpeed(const SimulatedRun& run, double begin_s, double span_s) {
  double largest = 0.0;
  for (std::size_t a = 0, b = 0; a < run.poses.size(); ++a) {
    if (run.Time_s(a) < begin_s) continue;
    while (b < run.poses.size() && run.Time_s(b) < run.Time_s(a) + span_s) ++b;
    if (b == run.poses.size()) break;
    const double way_m = (run.poses[b].T_world_body.t - run.poses[a].T_world_body.t).norm();
    largest = std::max(largest, way_m / (run.Time_s(b) - run.Time_s(a)));
  }
  return largest;
}

class StandingStill : public ::testing::TestWithParam<const char*> {};

TEST_P(StandingStill, IsNoMotion) {
  for (const std::uint64_t seed : {31, 32}) {
    const SimulatedRun run(Still(GetParam(), seed));
    const double first_m = run.poses[1].T_world_body.t.norm();
    EXPECT_LT(first_m / run.Time_s(1), 0.02) << "taken for a start in motion";
    // From pose to pose the noise of the points shows as centimetres per second; it has no mean.
    EXPECT_LT(LargestMeanSpeed(run, 0.6, 1.0), 0.03);
    EXPECT_LT((run.poses.back().T_world_body.t).norm(), 0.03);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, StandingStill,
                         ::testing::Values("hall_os1_16", "courtyard_os1_16", "office_os0_64",
                                           "facade_os1_16", "corridor_vlp16", "street_hdl64",
                                           "forest_mid360", "stairwell_xt32", "tall_room_os1_16",
                                           "square_os1_16x2"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace trajlo
