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

// A LiDAR that hangs below a drone sees a patch of the ground before it takes off: points enough
// now and then, and nothing of a place. That was taken for a place, which the body then had lost.
TEST(PartialView, ALidarThatSeesAPatchOfTheGroundAtFirstLosesNoPlace) {
  simulation::Scenario scenario = simulation::MakeScenario("survey_os1_128");
  scenario.scene = "forest";
  scenario.seed = 3;
  scenario.duration_s = 10.0;
  SE3 T_body_lidar;
  T_body_lidar.q = Eigen::AngleAxisd(0.785, Eigen::Vector3d::UnitY());
  scenario.rig = {simulation::MakeLidar("avia", T_body_lidar)};
  const testing::SimulatedRun run(scenario);
  EXPECT_FALSE(run.lost_at_ns);
  std::size_t seen = 0;  // The first pose that sees the wood around it.
  for (std::size_t i = 2; i < run.poses.size(); ++i) {  // The first two are those of the first map.
    const unsigned flags = run.poses[i].flags;
    if (run.Time_s(i) < 6.0) {
      EXPECT_NE(flags & (kFlagDegenerate | kFlagNoPoints), 0U) << i;
    } else if (run.Time_s(i) > 8.0) {
      EXPECT_EQ(flags, 0U) << i;
      if (seen == 0) seen = i;
    }
  }
  // Which way it looked before, nothing tells; from there on, it is followed.
  const SE3 moved = run.poses[seen].T_world_body.Inverse() * run.poses.back().T_world_body;
  const SE3 truth = run.truth[seen].Inverse() * run.truth.back();
  EXPECT_LT((moved.t - truth.t).norm(), 0.05);
  EXPECT_GT(truth.t.norm(), 3.0);
}

}  // namespace
}  // namespace trajlo
