// SPDX-License-Identifier: MIT
// Rigs as they are really known: two LiDARs make two walls of one until they are corrected.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/odometry/odometry.h"
#include "core/simulation/scenario.h"
#include "core/simulation/simulator.h"
#include "tests/support/bytes_of.h"

namespace trajlo {
namespace {

struct Result {
  double error_m;             ///< At the end of the recording.
  LidarCorrection left_over;  ///< What is still wrong with the second LiDAR.
  std::string poses;          ///< All control poses, byte by byte.
};

/// A flight with two LiDARs, the second of which needs `error` as a correction.
Result Fly(const char* scenario_name, const LidarCorrection& error, bool learns, int threads = 1) {
  simulation::Scenario scenario = simulation::MakeScenario(scenario_name);
  scenario.duration_s = 8.0;
  scenario.rig[1].clock_offset_s = -error.clock_s;
  const simulation::Simulator simulator(scenario);
  OdometryOptions options;
  options.threads = threads;
  options.segmenter.learn_rig = learns;
  options.segmenter.T_body_lidar = {scenario.rig[0].T_body_lidar,
                                    error.T_body.Inverse() * scenario.rig[1].T_body_lidar};
  Odometry odometry(options);
  simulation::SimulateScans(simulator, 2, [&](const auto& scan) { odometry.AddScan(scan.scan); });
  odometry.Finish();
  const std::vector<ControlPose>& poses = odometry.trajectory().poses();
  const SE3 T_world_start = simulator.TrueWorldFromBody(poses.front().t_ns);
  const SE3 truth = T_world_start.Inverse() * simulator.TrueWorldFromBody(poses.back().t_ns);
  Result result;
  result.error_m = (truth.t - poses.back().T_world_body.t).norm();
  const LidarCorrection found = odometry.rig().Correction(1);
  const SE3& T_body_lidar = options.segmenter.T_body_lidar[1];
  result.left_over.T_body = found.T_body * T_body_lidar * scenario.rig[1].T_body_lidar.Inverse();
  result.left_over.clock_s = found.clock_s - error.clock_s;
  for (const ControlPose& pose : poses) {
    result.poses += testing::BytesOf(pose.T_world_body.data(), 7);
  }
  return result;
}

/// Three centimetres, 1.4 degrees and 8 ms.
LidarCorrection WrongRig() {
  Vector6d tau;
  tau << 0.02, -0.01, 0.02, 0.01, 0.02, -0.01;
  return {se3::Exp(tau), 0.008};
}

void ExpectCorrected(const Result& result) {
  EXPECT_LT(result.left_over.T_body.t.norm(), 0.015);
  EXPECT_LT(so3::Log(result.left_over.T_body.q).norm(), 0.004);
  EXPECT_LT(std::abs(result.left_over.clock_s), 0.001);
}

class ImperfectRig : public ::testing::TestWithParam<const char*> {};

TEST_P(ImperfectRig, IsCorrected) {
  const Result corrected = Fly(GetParam(), WrongRig(), true);
  ExpectCorrected(corrected);
  EXPECT_LT(corrected.error_m, 0.06);
  EXPECT_LT(4.0 * corrected.error_m, Fly(GetParam(), WrongRig(), false).error_m);
}

TEST_P(ImperfectRig, ThatIsRightStaysSo) {
  const Result result = Fly(GetParam(), {}, true);
  ExpectCorrected(result);
  EXPECT_LT(result.error_m, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ImperfectRig,
                         ::testing::Values("hall_os1_16x2", "facade_fast_os1_16x2"));

TEST(ImperfectRig, IsCorrectedAlikeByAnyNumberOfThreads) {
  EXPECT_EQ(Fly("hall_os1_16x2", WrongRig(), true, 1).poses,
            Fly("hall_os1_16x2", WrongRig(), true, 3).poses);
}

}  // namespace
}  // namespace trajlo
