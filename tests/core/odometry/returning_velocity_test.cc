// SPDX-License-Identifier: MIT
// How long a body keeps a velocity is learnt from its motion.
#include <gtest/gtest.h>

#include "tests/support/simulated_run.h"

namespace trajlo {
namespace {

using testing::SimulatedRun;

/// The share of its velocity that a body is taken to keep for 0.3 s.
double LearntOn(const char* scenario_name, double duration_s) {
  simulation::Scenario scenario = simulation::MakeScenario(scenario_name);
  scenario.duration_s = duration_s;
  return SimulatedRun(scenario).windows.back().velocity_persistence;
}

TEST(ReturningVelocity, IsLearntOnARope) { EXPECT_LT(LearntOn("swing_avia", 5.0), 0.5); }

TEST(ReturningVelocity, IsNoneOfACarThatAccelerates) {
  EXPECT_GT(LearntOn("street_start_hdl64", 5.0), 0.9);
}

}  // namespace
}  // namespace trajlo
