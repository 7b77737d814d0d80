// SPDX-License-Identifier: MIT
// The odometry on scans of which all points have one time.
#include "core/scans/scan_times.h"
#include "tests/core/odometry/run_odometry.h"

namespace trajlo::testing {
namespace {

TEST(Odometry, MotionCorrectedScansWithAPauseStayFinite) {
  SyntheticWorld world;
  OdometryOptions options = RoomOptions();
  options.window.segments = 3;
  for (const double pause_s : {0.8, 1.2, 3.0}) {
    const RunResult run = RunOn(world, options, 20, [&](int i, LidarScan* scan) {
      scan->has_point_times = false;
      for (LidarPoint& point : scan->points) point.t_ns = scan->stamp_ns;
      if (i >= 10) ShiftTimes(std::llround(1e9 * pause_s), scan);
    });
    const auto& poses = run.odometry->trajectory().poses();
    ExpectFinite(run.odometry->trajectory());
    for (std::size_t i = 0; i < poses.size(); ++i) {
      EXPECT_LT(poses[i].T_world_body.t.norm(), 0.05) << "the sensor stands still";
      const std::int64_t before_ns = i > 0 ? poses[i - 1].t_ns : 0;
      EXPECT_GE(poses[i].t_ns - before_ns, 1'000'000);
    }
  }
}

/// All points as if measured at the scan's stamp.
void CorrectMotion(const SyntheticWorld& world, LidarScan* scan) {
  const auto pose_at = [&](std::int64_t t_ns) {
    return world.T_world_body(1e-9 * static_cast<double>(t_ns - world.start_ns));
  };
  const SE3 T_scan_world = pose_at(scan->stamp_ns).Inverse();
  for (LidarPoint& point : scan->points) {
    const SE3 T_world_point = pose_at(point.t_ns);
    point.xyz_m =
        (T_scan_world * (T_world_point * point.xyz_m.cast<double>().eval())).cast<float>();
    point.t_ns = scan->stamp_ns;
  }
  scan->has_point_times = false;
}

TEST(Odometry, RunsInDiscreteModeOnMotionCorrectedScans) {
  SyntheticWorld world;
  world.T_world_body = StartsAtRest;
  OdometryOptions options = RoomOptions();
  options.window.segments = 3;
  const auto correct_motion = [&](int, LidarScan* scan) { CorrectMotion(world, scan); };
  const RunResult run = RunOn(world, options, 25, correct_motion);
  ASSERT_EQ(run.odometry->trajectory().poses().size(), 25u);
  EXPECT_LT(LargestError(world, run.odometry->trajectory(), 2.5), 0.03);
}

/// A street of fences and walls along x, with poles beside it.
SyntheticWorld Street() {
  SyntheticWorld world;
  world.boxes = {{{-200, -7, -1.5}, {200, 8, 25}}};
  for (int i = -10; i < 20; ++i) {
    const double x = 7.0 * i + 2.0 * std::sin(5.0 * i);
    world.boxes.push_back({{x, -5.5, -1.5}, {x + 0.4, -5.1, 6.0}});
    world.boxes.push_back({{x + 3.0, 5.0, -1.5}, {x + 4.0 + 0.3 * std::cos(i), 8.0, 3.0}});
  }
  return world;
}

/// Along a street, without the second scan; the largest error.
double ErrorOfMotionCorrectedStart(double speed_m_s, bool estimate_motion) {
  SyntheticWorld world = Street();
  world.T_world_body = [&](double t) {
    return SE3(Eigen::Quaterniond::Identity(), {speed_m_s * t, 0.0, 0.0});
  };
  OdometryOptions options = RoomOptions();
  options.initialization.estimate_motion = estimate_motion;
  Odometry odometry(options);
  for (int i = 0; i < 15; ++i) {
    if (i == 1) continue;
    LidarScan scan = world.Sweep(i);
    CorrectMotion(world, &scan);
    odometry.AddScan(scan);
  }
  odometry.Finish();
  return LargestError(world, odometry.trajectory(), 2.0);
}

TEST(Odometry, MotionCorrectedScansMayStartInFastMotionWithoutTheSecondOne) {
  EXPECT_LT(ErrorOfMotionCorrectedStart(0.0, true), 0.1);
  EXPECT_LT(ErrorOfMotionCorrectedStart(10.0, true), 0.1);
  EXPECT_LT(ErrorOfMotionCorrectedStart(20.0, true), 0.1);
  EXPECT_GT(ErrorOfMotionCorrectedStart(20.0, false), 1.0) << "the scene would not need it";
}

TEST(Odometry, MotionCorrectedScansGoOnAsFastAsBeforeBehindACover) {
  SyntheticWorld world = Street();
  world.T_world_body = [](double t) {
    return SE3(Eigen::Quaterniond::Identity(), {5.0 * t, 0.0, 0.0});
  };
  const RunResult run = RunOn(world, RoomOptions(), 35, [&](int i, LidarScan* scan) {
    CorrectMotion(world, scan);
    const bool is_covered = 10 <= i && i < 20;
    if (!is_covered) return;
    for (LidarPoint& point : scan->points) point.xyz_m *= 0.6F / point.xyz_m.norm();
  });
  const std::int64_t seen_again_ns = world.start_ns + 2'000'000'000;
  const auto first = std::find_if(
      run.windows.begin(), run.windows.end(),
      [&](const WindowStatistics& window) { return window.begin_ns >= seen_again_ns; });
  ASSERT_NE(first, run.windows.end());
  EXPECT_LT(first->correction.translation_m, 0.05) << "0.5 m a scan were foreseen";
  EXPECT_LT(LargestError(world, run.odometry->trajectory(), 0.9), 0.1);
  const ControlPose& last = run.odometry->trajectory().poses().back();
  EXPECT_NEAR(last.T_world_body.t.x(), 5.0 * 3.4, 0.2);
}

}  // namespace
}  // namespace trajlo::testing
