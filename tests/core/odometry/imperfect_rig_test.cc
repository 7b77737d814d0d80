// SPDX-License-Identifier: MIT
// Extrinsics as they are really known: two LiDARs make two walls of one until they are corrected.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/odometry/odometry.h"
#include "core/simulation/scenario.h"
#include "core/simulation/simulator.h"
#include "tests/support/bytes_of.h"

namespace trajlo {
namespace {

struct Result {
  double error_m;     ///< At the end of the recording.
  SE3 left_over;      ///< Of the second LiDAR, from where it really is.
  std::string poses;  ///< All control poses, byte by byte.
};

/// A flight with two LiDARs, the second of which is said to sit where it is moved to by `error`.
Result Fly(const char* scenario_name, const SE3& error, bool learns, int threads = 1) {
  simulation::Scenario scenario = simulation::MakeScenario(scenario_name);
  scenario.duration_s = 8.0;
  const simulation::Simulator simulator(scenario);
  OdometryOptions options;
  options.threads = threads;
  options.segmenter.learn_extrinsics = learns;
  const SE3 T_body_first = scenario.rig[0].T_body_lidar;
  const SE3 T_body_second = scenario.rig[1].T_body_lidar;
  options.segmenter.T_body_lidar = {T_body_first, error * T_body_second};
  Odometry odometry(options);
  simulation::SimulateScans(simulator, 2, [&](const auto& scan) { odometry.AddScan(scan.scan); });
  odometry.Finish();
  const std::vector<ControlPose>& poses = odometry.trajectory().poses();
  const SE3 T_world_start = simulator.TrueWorldFromBody(poses.front().t_ns);
  const SE3 truth = T_world_start.Inverse() * simulator.TrueWorldFromBody(poses.back().t_ns);
  Result result;
  result.error_m = (truth.t - poses.back().T_world_body.t).norm();
  result.left_over = odometry.T_body_lidar()[1] * T_body_second.Inverse();
  for (const ControlPose& pose : poses) {
    result.poses += testing::BytesOf(pose.T_world_body.data(), 7);
  }
  return result;
}

/// Three centimetres and 1.4 degrees.
SE3 WrongPose() {
  Vector6d tau;
  tau << 0.02, -0.01, 0.02, 0.01, 0.02, -0.01;
  return se3::Exp(tau);
}

void ExpectCorrected(const Result& result) {
  EXPECT_LT(result.left_over.t.norm(), 0.015);
  EXPECT_LT(so3::Log(result.left_over.q).norm(), 0.004);
}

/// Uncorrected, the hall ends 0.07 m off and the facade 0.33 m.
class ImperfectRig : public ::testing::TestWithParam<const char*> {};

TEST_P(ImperfectRig, IsCorrected) {
  const Result corrected = Fly(GetParam(), WrongPose(), true);
  ExpectCorrected(corrected);
  EXPECT_LT(corrected.error_m, 0.06);
  EXPECT_LT(5.0 * corrected.error_m, Fly(GetParam(), WrongPose(), false).error_m);
}

TEST_P(ImperfectRig, ThatIsRightStaysSo) {
  const Result result = Fly(GetParam(), SE3(), true);
  ExpectCorrected(result);
  EXPECT_LT(result.error_m, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ImperfectRig,
                         ::testing::Values("hall_os1_16x2", "facade_fast_os1_16x2"));

TEST(ImperfectRig, IsCorrectedAlikeByAnyNumberOfThreads) {
  EXPECT_EQ(Fly("hall_os1_16x2", WrongPose(), true, 1).poses,
            Fly("hall_os1_16x2", WrongPose(), true, 3).poses);
}

}  // namespace
}  // namespace trajlo
