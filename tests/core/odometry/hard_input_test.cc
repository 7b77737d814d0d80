// SPDX-License-Identifier: MIT
// The odometry on recordings with gaps, wrong stamps, broken scans and lost views.
#include <limits>

#include "core/scans/scan_times.h"
#include "tests/core/odometry/run_odometry.h"

namespace trajlo::testing {
namespace {

TEST(Odometry, AGapInTheStreamIsBridgedBySmoothness) {
  SyntheticWorld world;
  world.T_world_body = ConstantTwist;
  OdometryOptions options = RoomOptions();
  RunResult run;
  Odometry odometry(options);
  unsigned flags = 0;
  odometry.OnWindow([&](const WindowStatistics& w) { flags |= w.flags; });
  for (int i = 0; i < 24; ++i) {
    if (i == 12 || i == 13) continue;
    odometry.AddScan(world.Sweep(i));
  }
  odometry.Finish();
  ExpectFinite(odometry.trajectory());
  EXPECT_TRUE(flags & kFlagNoPoints);
  EXPECT_LT(LargestError(world, odometry.trajectory(), 2.35), 0.1);
}

constexpr std::int64_t kDays_ns = 5LL * 24 * 3600 * 1'000'000'000;

TEST(Odometry, APauseIsOneGapAndTheRunGoesOn) {
  SyntheticWorld world;
  const RunResult run = RunOn(world, RoomOptions(), 16, [&](int i, LidarScan* scan) {
    if (i >= 8) ShiftTimes(20'000'000'000, scan);
  });
  ExpectFinite(run.odometry->trajectory());
  EXPECT_LT(run.windows.size(), 60u);
  EXPECT_GT(run.windows.size(), 40u);
  bool flagged = false;
  for (const ControlPose& pose : run.odometry->trajectory().poses()) {
    flagged = flagged || (pose.flags & kFlagGap);
  }
  EXPECT_TRUE(flagged);
}

/// The body moves 2 m between the first scan that sees something and the next one: nothing tells
/// how.
TEST(Odometry, BeginsWhereItSeesSomethingForLong) {
  SyntheticWorld world;
  world.T_world_body = ConstantTwist;
  Odometry odometry(RoomOptions());
  int poses = 0;
  odometry.OnPose([&](const ControlPose&, const Matrix6d&) { ++poses; });
  for (int i = 0; i < 26; ++i) {
    LidarScan scan = world.Sweep(i);
    for (LidarPoint& point : scan.points) {
      if (i >= 1 && i <= 14) point.xyz_m.setZero();
    }
    odometry.AddScan(scan);
  }
  odometry.Finish();
  const auto& found = odometry.trajectory().poses();
  ASSERT_GT(found.size(), 25u);
  EXPECT_EQ(poses, static_cast<int>(found.size()));
  EXPECT_GE(odometry.time_report().before_first_pose, 14);
  const std::int64_t begin_ns = found.front().t_ns;
  EXPECT_GE(begin_ns, world.start_ns + 1'490'000'000);
  EXPECT_LE(begin_ns, world.start_ns + 1'510'000'000);
  const auto truth = [&](std::int64_t t_ns) {
    return world.T_world_body(1e-9 * static_cast<double>(t_ns - world.start_ns));
  };
  for (const ControlPose& pose : found) {
    EXPECT_EQ(pose.flags & kFlagGap, 0u);
    const SE3 moved = truth(begin_ns).Inverse() * truth(pose.t_ns);
    EXPECT_LT((moved.t - pose.T_world_body.t).norm(), 0.03);
  }
}

/// Fifteen points are no map, however many levels the map has.
TEST(Odometry, DoesNotBeginAtAHandfulOfPoints) {
  SyntheticWorld world;
  const RunResult run = RunOn(world, RoomOptions(), 20, [](int i, LidarScan* scan) {
    if (i > 2) return;
    for (std::size_t k = 0; k < scan->points.size(); ++k) {
      if (k % (scan->points.size() / 5) != 0) scan->points[k].xyz_m.setZero();
    }
  });
  ASSERT_FALSE(run.odometry->trajectory().empty());
  const auto& first = run.odometry->trajectory().poses().front();
  EXPECT_GT(first.t_ns, world.start_ns + 290'000'000);
}

TEST(Odometry, WrongStampsNeitherEndTheRunNorMoveIt) {
  SyntheticWorld world;
  world.T_world_body = StartsAtRest;
  const std::vector<std::function<void(int, LidarScan*)>> faults = {
      [](int i, LidarScan* scan) { ShiftTimes(i == 0 ? kDays_ns : 0, scan); },
      [](int i, LidarScan* scan) { ShiftTimes(i == 8 ? kDays_ns : 0, scan); },
      [](int i, LidarScan* scan) { ShiftTimes(i == 8 ? 2'000'000'000 : 0, scan); },
      [](int i, LidarScan* scan) { ShiftTimes(i >= 8 ? -3'600'000'000'000 : 0, scan); },
      [](int i, LidarScan* scan) { ShiftTimes(i >= 8 ? kDays_ns : 0, scan); },
      [](int i, LidarScan* scan) { ShiftTimes(i == 8 ? -100'000'000 : 0, scan); },
      [](int, LidarScan* scan) { scan->points[100].t_ns += 1'500'000'000; },
  };
  for (std::size_t k = 0; k < faults.size(); ++k) {
    const RunResult run = RunOn(world, RoomOptions(), 20, faults[k]);
    const auto& poses = run.odometry->trajectory().poses();
    ASSERT_GT(poses.size(), 55u) << k;
    EXPECT_GT(poses.back().t_ns, world.start_ns + 1'950'000'000) << k;
    EXPECT_LT(poses.back().t_ns, world.start_ns + 2'050'000'000) << k;
    EXPECT_LT(LargestError(world, run.odometry->trajectory(), 1.95), 0.03) << k;
    for (const ControlPose& pose : poses) EXPECT_FALSE(pose.flags & kFlagGap) << k;
    EXPECT_LT(run.odometry->point_counts().too_late, 100) << k;
  }
}

TEST(Odometry, ScansOfNaNsEmptyScansAndRepeatedScansDoNotStopIt) {
  SyntheticWorld world;
  world.T_world_body = StartsAtRest;
  const LidarScan repeated = world.Sweep(5);
  const RunResult run = RunOn(world, RoomOptions(), 20, [&](int i, LidarScan* scan) {
    if (i == 8) {
      for (LidarPoint& point : scan->points) {
        point.xyz_m.setConstant(std::numeric_limits<float>::quiet_NaN());
      }
    }
    if (i == 11) scan->points.clear();
    if (i == 14) *scan = repeated;
  });
  ExpectFinite(run.odometry->trajectory());
  EXPECT_EQ(run.odometry->point_counts().not_finite, 32 * 360);
  EXPECT_EQ(run.odometry->point_counts().wrong_time, 32 * 360);
  EXPECT_EQ(run.odometry->time_report().repeated, 1);
  EXPECT_LT(LargestError(world, run.odometry->trajectory(), 1.95), 0.1);
}

TEST(Odometry, CountsTheScansBehindTheLastPose) {
  SyntheticWorld world;
  const RunResult run = RunOn(world, RoomOptions(), 30, [](int i, LidarScan* scan) {
    if (i < 20) return;
    if (i % 3 == 0) {
      scan->points.clear();
    } else {
      for (LidarPoint& point : scan->points) point.xyz_m *= i % 3 == 1 ? 0.0F : 1e6F;
    }
  });
  EXPECT_EQ(run.odometry->time_report().Unseen(), 10);
}

TEST(Odometry, SaysThatItIsLostWhenTheWorldDisappears) {
  SyntheticWorld world;
  // A search among points without order is slow: few of them.
  world.beams = 16;
  world.columns = 60;
  const RunResult run = RunOn(world, RoomOptions(), 40, [&](int i, LidarScan* scan) {
    if (i < 10) return;
    Random random(static_cast<unsigned>(i));
    for (LidarPoint& point : scan->points) {
      point.xyz_m = random.Vector(20, 90).cast<float>();
    }
  });
  ASSERT_TRUE(run.odometry->lost_at_ns());
  EXPECT_GE(*run.odometry->lost_at_ns(), world.start_ns + 900'000'000);
  EXPECT_LT(LargestError(world, run.odometry->trajectory(), 0.85), 0.05);
  ExpectFinite(run.odometry->trajectory());
}

TEST(Odometry, FlagsPosesAtOnceIfItWouldBeLostWereItToGoOn) {
  SyntheticWorld world;
  // For the last 0.6 s, four points of five are those of another world.
  const RunResult run = RunOn(world, RoomOptions(), 40, [&](int i, LidarScan* scan) {
    if (i < 34) return;
    Random random(static_cast<unsigned>(i));
    for (std::size_t k = 0; k < scan->points.size(); ++k) {
      if (k % 5 != 0) scan->points[k].xyz_m = random.Vector(20, 90).cast<float>();
    }
  });
  EXPECT_FALSE(run.odometry->lost_at_ns());
  constexpr double kWindow_s = 0.12;
  for (const ControlPose& pose : run.odometry->trajectory().poses()) {
    const double t_s = 1e-9 * static_cast<double>(pose.t_ns - world.start_ns);
    if (t_s < 3.4 - kWindow_s) {
      EXPECT_EQ(pose.flags & kFlagFewInliers, 0U) << t_s;
    } else if (t_s > 3.4 + kWindow_s) {
      EXPECT_EQ(pose.flags & kFlagFewInliers, +kFlagFewInliers) << t_s;
    }
  }
}

TEST(Odometry, FlagsTheFirstPoseTooIfNothingAgreesWithTheFirstInterval) {
  SyntheticWorld world;
  // Behind the first interval of 0.3 s, all is another world at every scan.
  const RunResult run = RunOn(world, RoomOptions(), 12, [&](int i, LidarScan* scan) {
    Random random(static_cast<unsigned>(i));
    for (LidarPoint& point : scan->points) {
      if (i >= 3) point.xyz_m = random.Vector(20, 90).cast<float>();
    }
  });
  ASSERT_FALSE(run.odometry->trajectory().empty());
  EXPECT_NE(run.odometry->trajectory().poses().front().flags & kFlagFewInliers, 0U);
}

TEST(Odometry, NothingAndOneScanAreValidRecordings) {
  SyntheticWorld world;
  Odometry nothing(RoomOptions());
  nothing.Finish();
  EXPECT_TRUE(nothing.trajectory().empty());
  const RunResult run = RunOn(world, RoomOptions(), 1);
  ExpectFinite(run.odometry->trajectory());
}

}  // namespace
}  // namespace trajlo::testing
