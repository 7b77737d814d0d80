// SPDX-License-Identifier: MIT
// A LiDAR at the side of a vehicle sees nothing in a part of every turn. For so short a time the
// motion prior is as good as points, and that is no reason for doubt.
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/simulated_run.h"

namespace trajlo {
namespace {

int PosesWithoutPoints(const testing::SimulatedRun& run) {
  int count = 0;
  for (const ControlPose& pose : run.poses) count += (pose.flags & kFlagNoPoints) != 0 ? 1 : 0;
  return count;
}

/// Leaves nothing of a scan behind the LiDAR.
void SeeAheadOnly(LidarScan* scan) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  for (LidarPoint& point : scan->points) {
    if (point.xyz_m.x() < 0.5F * point.xyz_m.norm()) point.xyz_m.setConstant(kNaN);
  }
}

TEST(PartialView, ATurnWithABlindSideIsNoDoubt) {
  for (const char* name : {"street_start_hdl64", "car_park_os1_128"}) {
    simulation::Scenario scenario = simulation::MakeScenario(name);
    scenario.duration_s = 5.0;
    const testing::SimulatedRun run(scenario, OdometryOptions(), SeeAheadOnly);
    EXPECT_LT(run.LargestError_m(), 0.05) << name;
    EXPECT_LT(PosesWithoutPoints(run), 5) << name;
    int blind_windows = 0;
    for (const WindowStatistics& window : run.windows) {
      blind_windows += (window.flags & kFlagNoPoints) != 0 ? 1 : 0;
    }
    EXPECT_GT(blind_windows, 50) << name;  // Of 160. What happened is still told.
  }
}

TEST(PartialView, HalfASecondWithoutPointsIs) {
  simulation::Scenario scenario = simulation::MakeScenario("office_os0_64");
  scenario.duration_s = 5.0;
  std::int64_t first_ns = 0;
  const testing::SimulatedRun run(scenario, OdometryOptions(), [&](LidarScan* scan) {
    if (first_ns == 0) first_ns = scan->stamp_ns;
    const double t_s = 1e-9 * static_cast<double>(scan->stamp_ns - first_ns);
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    if (t_s < 3.05 || t_s > 3.45) return;
    for (LidarPoint& point : scan->points) point.xyz_m.setConstant(kNaN);
  });
  EXPECT_GT(PosesWithoutPoints(run), 5);  // Of 14; the first ones are near enough.
}

}  // namespace
}  // namespace trajlo
