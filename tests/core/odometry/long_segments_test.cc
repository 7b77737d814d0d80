// SPDX-License-Identifier: MIT
// One segment a scan: what its points saw on the way lies on no straight motion, and windows take
// more rounds. They do not get lost for that.
#include <gtest/gtest.h>

#include "tests/support/simulated_run.h"

namespace trajlo {
namespace {

class LongSegments : public ::testing::TestWithParam<const char*> {};

TEST_P(LongSegments, AreFollowed) {
  simulation::Scenario scenario = simulation::MakeScenario(GetParam());
  scenario.duration_s = 12.0;
  OdometryOptions options;
  options.segmenter.interval_s = 0.1;
  const testing::SimulatedRun run(scenario, options);
  EXPECT_FALSE(run.lost_at_ns);
  EXPECT_LT(run.LargestError_m(), 0.25);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, LongSegments,
                         ::testing::Values("courtyard_os1_16", "square_os1_16x2"));

}  // namespace
}  // namespace trajlo
