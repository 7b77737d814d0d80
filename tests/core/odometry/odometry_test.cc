// SPDX-License-Identifier: MIT
#include <algorithm>
#include <stdexcept>
#include <string>

#include "tests/core/odometry/run_odometry.h"

namespace trajlo::testing {
namespace {

class EverySolver : public ::testing::TestWithParam<SolverKind> {};

TEST_P(EverySolver, FollowsAPathThatStartsAtRest) {
  SyntheticWorld world;
  world.T_world_body = StartsAtRest;
  OdometryOptions options = RoomOptions();
  options.solver.kind = GetParam();
  const RunResult run = RunOn(world, options, 30);
  EXPECT_LT(LargestError(world, run.odometry->trajectory(), 2.95), 0.03);
  EXPECT_FALSE(run.odometry->lost_at_ns());
}

TEST_P(EverySolver, FollowsAPathThatStartsInMotion) {
  SyntheticWorld world;
  world.T_world_body = ConstantTwist;
  OdometryOptions options = RoomOptions();
  options.solver.kind = GetParam();
  const RunResult run = RunOn(world, options, 25);
  EXPECT_LT(LargestError(world, run.odometry->trajectory(), 2.45), 0.03);
}

INSTANTIATE_TEST_SUITE_P(Solvers, EverySolver,
                         ::testing::Values(SolverKind::kCeres, SolverKind::kGaussNewton));

TEST(Odometry, AStationaryAssumptionWouldHaveLostTheMovingStart) {
  SyntheticWorld world;
  world.T_world_body = ConstantTwist;
  OdometryOptions options = RoomOptions();
  options.initialization.estimate_motion = false;
  const RunResult run = RunOn(world, options, 15);
  EXPECT_GT(LargestError(world, run.odometry->trajectory(), 1.45), 0.1);
}

TEST(Odometry, StaysWhereItIsWhileTheSensorStandsStill) {
  const SyntheticWorld world;
  const RunResult run = RunOn(world, RoomOptions(), 20);
  EXPECT_LT(LargestError(world, run.odometry->trajectory(), 1.95), 0.005);
}

TEST(Odometry, CeresAndGaussNewtonGiveTheSameTrajectory) {
  SyntheticWorld world;
  world.T_world_body = StartsAtRest;
  for (const int iterations : {1, 3}) {
    OdometryOptions options = RoomOptions();
    options.solver.iterations_per_round = iterations;
    options.solver.kind = SolverKind::kCeres;
    const RunResult ceres = RunOn(world, options, 15);
    options.solver.kind = SolverKind::kGaussNewton;
    const RunResult gauss_newton = RunOn(world, options, 15);
    const auto& a = ceres.odometry->trajectory().poses();
    const auto& b = gauss_newton.odometry->trajectory().poses();
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      // The last bits differ, and a window hands its rounding on to the next. After several steps
      // Ceres has linearised at the solution, where Gauss-Newton shifts by the last step.
      EXPECT_LT((a[i].T_world_body.t - b[i].T_world_body.t).norm(), iterations == 1 ? 1e-8 : 1e-5)
          << i;
    }
  }
}

TEST(Odometry, GivesTheSameBytesForAnyNumberOfThreads) {
  SyntheticWorld world;
  world.T_world_body = StartsAtRest;
  OdometryOptions options = RoomOptions();
  options.threads = 1;
  const RunResult one = RunOn(world, options, 15);
  const auto& a = one.odometry->trajectory().poses();
  for (const int threads : {2, 4}) {
    options.threads = threads;
    const RunResult several = RunOn(world, options, 15);
    const auto& b = several.odometry->trajectory().poses();
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double* const pose = a[i].T_world_body.data();
      EXPECT_TRUE(std::equal(pose, pose + 7, b[i].T_world_body.data())) << i;
    }
    EXPECT_EQ(several.odometry->map().finest().size(), one.odometry->map().finest().size());
  }
}

TEST(Odometry, WhatCallbacksThrowReachesTheCallerAndFinishSettlesTheRest) {
  const SyntheticWorld world;
  OdometryOptions options = RoomOptions();
  for (const int threads : {1, 2}) {
    options.threads = threads;
    Odometry odometry(options);
    int poses = 0;
    odometry.OnPose([&](const ControlPose&, const Matrix6d&) {
      if (++poses == 5) throw std::runtime_error("bad pose");
    });
    int windows = 0;
    odometry.OnWindow([&](const WindowStatistics&) {
      if (++windows == 20) throw std::runtime_error("bad window");
    });
    odometry.OnScan([&](const LidarScan& scan) {
      if (scan.stamp_ns >= world.start_ns + 1'250'000'000) throw std::runtime_error("bad scan");
    });
    std::vector<std::string> failures;
    for (int i = 0; i < 14; ++i) {
      try {
        odometry.AddScan(world.Sweep(i));
      } catch (const std::runtime_error& error) {
        failures.emplace_back(error.what());
      }
    }
    EXPECT_EQ(failures, (std::vector<std::string>{"bad pose", "bad window", "bad scan"}));
    const std::size_t settled = odometry.trajectory().poses().size();
    odometry.Finish();
    EXPECT_GT(odometry.trajectory().poses().size(), settled);
    EXPECT_EQ(poses, static_cast<int>(odometry.trajectory().poses().size()));
    ExpectFinite(odometry.trajectory());
  }
}

TEST(Odometry, WindowsThatAreAskedForComeAsTheyWereSolvedAndChangeNothing) {
  SyntheticWorld world;
  world.T_world_body = StartsAtRest;
  const RunResult plain = RunOn(world, RoomOptions(), 12);
  Odometry odometry(RoomOptions());
  std::vector<std::int64_t> asked;
  odometry.OnSolvedWindow([](std::int64_t index) { return index % 7 == 3; },
                          [&](std::int64_t index, const Window& window) {
                            asked.push_back(index);
                            const WindowStatistics& as_told =
                                plain.windows[static_cast<std::size_t>(index)];
                            EXPECT_EQ(window.begin_ns, as_told.begin_ns);
                            EXPECT_EQ(window.EndNs(), as_told.end_ns);
                            EXPECT_EQ(window.size(), as_told.segments);
                            int points = 0;
                            for (const Segment& segment : window.segments) {
                              points += static_cast<int>(segment.points.size());
                            }
                            EXPECT_EQ(points, as_told.inliers);
                          });
  for (int i = 0; i < 12; ++i) odometry.AddScan(world.Sweep(i));
  odometry.Finish();
  EXPECT_EQ(asked.front(), 3);
  EXPECT_EQ(asked.size(), (plain.windows.size() + 3) / 7);
  const auto& a = plain.odometry->trajectory().poses();
  const auto& b = odometry.trajectory().poses();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].T_world_body.t, b[i].T_world_body.t) << i;
  }
}

/// A body that starts in motion has several windows at once. A callback that throws in the first of
/// them takes nothing from the trajectory.
TEST(Odometry, ACallbackThatThrowsAtAStartInMotionLosesNothing) {
  SyntheticWorld world;
  world.T_world_body = ConstantTwist;
  const OdometryOptions options = RoomOptions();
  const RunResult quiet = RunOn(world, options, 8);
  Odometry odometry(options);
  int windows = 0, failures = 0;
  odometry.OnWindow([&](const WindowStatistics&) {
    if (++windows == 1) throw std::runtime_error("full");
  });
  for (int i = 0; i < 8; ++i) {
    try {
      odometry.AddScan(world.Sweep(i));
    } catch (const std::runtime_error&) {
      ++failures;
    }
  }
  odometry.Finish();
  EXPECT_EQ(failures, 1);
  const auto& a = quiet.odometry->trajectory().poses();
  const auto& b = odometry.trajectory().poses();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].T_world_body.t, b[i].T_world_body.t);
}

TEST(Odometry, FinishAfterACallbackThrewInItHandsOnTheRest) {
  const SyntheticWorld world;
  Odometry odometry(RoomOptions());
  bool is_finishing = false;
  int poses = 0, failures = 0;
  odometry.OnPose([&](const ControlPose&, const Matrix6d&) {
    ++poses;
    if (is_finishing && ++failures <= 2) throw std::runtime_error("full");
  });
  for (int i = 0; i < 8; ++i) odometry.AddScan(world.Sweep(i));
  is_finishing = true;
  EXPECT_THROW(odometry.Finish(), std::runtime_error);
  const std::size_t settled = odometry.trajectory().poses().size();
  const std::int64_t scans = odometry.time_report().scans;
  EXPECT_THROW(odometry.Finish(), std::runtime_error);
  odometry.Finish();
  odometry.Finish();
  EXPECT_EQ(odometry.trajectory().poses().size(), settled);
  EXPECT_EQ(poses, static_cast<int>(settled));
  EXPECT_EQ(odometry.time_report().scans, scans);
}

TEST(Odometry, WorksOnTheKdTreeMapToo) {
  SyntheticWorld world;
  world.T_world_body = StartsAtRest;
  OdometryOptions options = RoomOptions();
  options.map.finest.kind = MapKind::kKdTree;
  const RunResult run = RunOn(world, options, 15);
  EXPECT_LT(LargestError(world, run.odometry->trajectory(), 1.45), 0.03);
}

TEST(Odometry, WorksWithFirstEstimates) {
  SyntheticWorld world;
  world.T_world_body = StartsAtRest;
  OdometryOptions options = RoomOptions();
  options.marginalization.first_estimate_jacobians = true;
  EXPECT_LT(LargestError(world, RunOn(world, options, 15).odometry->trajectory(), 1.45), 0.03);
}

TEST(Odometry, DeskewingByPredictionIsAsGoodAtConstantTwistAndWorseInAShake) {
  SyntheticWorld world;
  const auto errors = [&world](Deskewing deskewing) {
    OdometryOptions options = RoomOptions();
    options.segmenter.interval_s = 0.1;
    options.window.deskewing = deskewing;
    return LargestError(world, RunOn(world, options, 20).odometry->trajectory(), 1.95);
  };
  world.T_world_body = ConstantTwist;
  EXPECT_LT(errors(Deskewing::kPredicted), 0.03);
  world.T_world_body = [](double t) {
    const double s = std::max(0.0, t - 0.5);
    return SE3(so3::Exp({0.0, 0.0, 0.15 * (1.0 - std::cos(8.0 * s))}), {0.3 * s * s, 0.0, 0.0});
  };
  EXPECT_GT(errors(Deskewing::kPredicted), 2.0 * errors(Deskewing::kEstimated));
}

TEST(Odometry, TwoLidarsWithExtrinsicsMakeOneTrajectory) {
  SyntheticWorld world;
  world.T_world_body = StartsAtRest;
  const SE3 T_body_second(so3::Exp({0.0, M_PI / 2, 0.0}), {-0.35, 0.03, -0.05});
  SyntheticWorld second = world;
  second.T_world_body = [&](double t) { return StartsAtRest(t) * T_body_second; };
  OdometryOptions options = RoomOptions();
  options.segmenter.T_body_lidar = {SE3(), T_body_second};
  Odometry odometry(options);
  for (int i = 0; i < 20; ++i) {
    odometry.AddScan(world.Sweep(i));
    LidarScan scan = second.Sweep(i);
    scan.lidar_id = 1;
    odometry.AddScan(scan);
  }
  odometry.Finish();
  EXPECT_LT(LargestError(world, odometry.trajectory(), 1.95), 0.02);
}

TEST(Odometry, DropsTheMapThatItHasLeft) {
  SyntheticWorld world;
  world.T_world_body = ConstantTwist;
  OdometryOptions options = RoomOptions();
  options.segmenter.max_range_m = 6.0;
  const RunResult all = RunOn(world, options, 30);
  options.map.finest.radius_m = 6.0;
  const RunResult near = RunOn(world, options, 30);
  EXPECT_LT(near.odometry->map().finest().size(), all.odometry->map().finest().size() * 3 / 4);
}

TEST(Odometry, KeepsTheMapThatIsInRange) {
  SyntheticWorld world;
  world.T_world_body = ConstantTwist;
  OdometryOptions options = RoomOptions();
  const RunResult all = RunOn(world, options, 10);
  options.map.finest.radius_m = 1.0;
  const RunResult near = RunOn(world, options, 10);
  EXPECT_EQ(near.odometry->map().finest().size(), all.odometry->map().finest().size());
}

TEST(Odometry, KeepsItsOwnCopyOfTheOptions) {
  SyntheticWorld world;
  world.T_world_body = StartsAtRest;
  auto options = std::make_unique<OdometryOptions>(RoomOptions());
  Odometry odometry(*options);
  options->window.segments = 1;
  options->registration.sigma_m = 10.0;
  options.reset();
  for (int i = 0; i < 10; ++i) odometry.AddScan(world.Sweep(i));
  odometry.Finish();
  EXPECT_LT(LargestError(world, odometry.trajectory(), 0.95), 0.03);
}

}  // namespace
}  // namespace trajlo::testing
