// SPDX-License-Identifier: MIT
// Trajectories of short simulated recordings against those of an earlier version: a change that
// moves them is seen here first. Where it is meant, TRAJLO_WRITE_GOLDEN=1 writes them anew.
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/io/trajectory_reader.h"
#include "core/io/trajectory_writer.h"
#include "core/odometry/odometry.h"
#include "core/simulation/scenario.h"
#include "core/simulation/simulator.h"

namespace trajlo {
namespace {

/// Compilers round differently: their trajectories are up to 3.3 mm and 2.2 mrad apart.
constexpr double kSame_m = 0.005;
constexpr double kSame_rad = 0.003;

struct Golden {
  const char* scenario;
  double duration_s;
  /// The largest error against the simulator's truth, in the frame of the first pose.
  double largest_error_m;
};

class GoldenTrajectory : public ::testing::TestWithParam<Golden> {};

TEST_P(GoldenTrajectory, IsTheSameAndCloseToTheTruth) {
  simulation::Scenario scenario = simulation::MakeScenario(GetParam().scenario);
  scenario.duration_s = GetParam().duration_s;
  OdometryOptions options;
  for (const auto& lidar : scenario.rig) {
    options.segmenter.T_body_lidar.push_back(lidar.T_body_lidar);
  }
  const simulation::Simulator simulator(scenario);
  Odometry odometry(options);
  simulation::SimulateScans(simulator, 2,
                            [&](const auto& simulated) { odometry.AddScan(simulated.scan); });
  odometry.Finish();
  const std::vector<ControlPose>& poses = odometry.trajectory().poses();

  const std::string path = std::string(TRAJLO_TEST_DIR) + "/golden/" + GetParam().scenario + ".tum";
  if (std::getenv("TRAJLO_WRITE_GOLDEN") != nullptr) {
    TumWriter writer(path, IfExists::kReplace);
    for (const ControlPose& pose : poses) writer.Append(pose.t_ns, pose.T_world_body);
    writer.Close();
  }
  const std::vector<StampedPose> golden = ReadTum(path);
  ASSERT_EQ(poses.size(), golden.size());
  const SE3 T_start_world = simulator.TrueWorldFromBody(poses.front().t_ns).Inverse();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    ASSERT_EQ(poses[i].t_ns, golden[i].t_ns);
    const SE3 difference = golden[i].T_world_body.Inverse() * poses[i].T_world_body;
    EXPECT_LT(difference.t.norm(), kSame_m) << i;
    EXPECT_LT(so3::Log(difference.q).norm(), kSame_rad) << i;
    const SE3 truth = T_start_world * simulator.TrueWorldFromBody(poses[i].t_ns);
    EXPECT_LT((poses[i].T_world_body.t - truth.t).norm(), GetParam().largest_error_m) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Simulated, GoldenTrajectory,
                         ::testing::Values(Golden{"hall_os1_16", 4.0, 0.1},
                                           Golden{"street_hdl64", 2.0, 0.1},
                                           Golden{"hall_os1_16x2", 3.0, 0.05}),
                         [](const auto& golden) { return std::string(golden.param.scenario); });

}  // namespace
}  // namespace trajlo
