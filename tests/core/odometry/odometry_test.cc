// SPDX-License-Identifier: MIT
#include "core/odometry/odometry.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/scans/scan_times.h"
#include "tests/support/synthetic_world.h"

namespace trajlo {
namespace {

using testing::SyntheticWorld;

OdometryOptions RoomOptions() {
  OdometryOptions options;
  options.segmenter.registration_voxel_m = 0.5;
  return options;
}

/// At rest for half a second, then ever faster on a bent path, with a turn.
SE3 StartsAtRest(double t) {
  const double s = std::max(0.0, t - 0.5);
  const double way = s * s * s / (1.0 + s * s);
  Vector6d tau;
  tau << 0.8 * way, 0.2 * way, 0.1 * std::sin(way), 0.05 * std::sin(2 * way), 0, 0.4 * way;
  return se3::Exp(tau);
}

/// A constant twist, which linear interpolation represents exactly: 1.5 m/s and 0.6 rad/s.
SE3 ConstantTwist(double t) {
  Vector6d twist;
  twist << 1.4, 0.5, 0.1, 0.1, 0.0, 0.6;
  return se3::Exp(t * twist);
}

struct RunResult {
  std::unique_ptr<Odometry> odometry;
  std::vector<WindowStatistics> windows;
};

RunResult RunOn(const SyntheticWorld& world, const OdometryOptions& options, int sweeps,
                const std::function<void(int, LidarScan*)>& change = {}) {
  RunResult run;
  run.odometry = std::make_unique<Odometry>(options);
  run.odometry->OnWindow([&](const WindowStatistics& w) { run.windows.push_back(w); });
  for (int i = 0; i < sweeps; ++i) {
    LidarScan scan = world.Sweep(i);
    if (change) change(i, &scan);
    run.odometry->AddScan(scan);
  }
  run.odometry->Finish();
  return run;
}

/// Largest position error against the truth, in the frame of the first pose.
double LargestError(const SyntheticWorld& world, const Trajectory& trajectory, double until_s) {
  const SE3 T_start = world.T_world_body(0.0);
  double largest = 0.0;
  for (const ControlPose& pose : trajectory.poses()) {
    const double t = 1e-9 * static_cast<double>(pose.t_ns - world.start_ns);
    if (t > until_s) break;
    const SE3 truth = T_start.Inverse() * world.T_world_body(t);
    largest = std::max(largest, (truth.t - pose.T_world_body.t).norm());
  }
  return largest;
}

void ExpectFinite(const Trajectory& trajectory) {
  ASSERT_FALSE(trajectory.empty());
  for (const ControlPose& pose : trajectory.poses()) ASSERT_TRUE(pose.T_world_body.IsFinite());
}

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

TEST(Odometry, HandsOutACovarianceForEveryPose) {
  SyntheticWorld world;
  world.T_world_body = StartsAtRest;
  OdometryOptions options = RoomOptions();
  Odometry odometry(options);
  std::vector<Matrix6d> covariances;
  odometry.OnPose([&](const ControlPose&, const Matrix6d& C) { covariances.push_back(C); });
  for (int i = 0; i < 10; ++i) odometry.AddScan(world.Sweep(i));
  odometry.Finish();
  ASSERT_EQ(covariances.size(), odometry.trajectory().poses().size());
  EXPECT_EQ(covariances.front(), Matrix6d::Zero());  // It defines the world.
  for (std::size_t i = 1; i < covariances.size(); ++i) {
    EXPECT_EQ(covariances[i], covariances[i].transpose());
    const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(covariances[i]);
    EXPECT_GT(eigen.eigenvalues()[0], 0.0);
    EXPECT_LT(std::sqrt(eigen.eigenvalues()[5]), 0.1);
  }
}

/// The mean of e' C^-1 e / 6 over poses a second apart, from 1.5 s on: see check_covariance.py.
double NormalisedErrorOfRelativePoses(const SyntheticWorld& world, int sweeps) {
  Odometry odometry(RoomOptions());
  std::vector<ControlPose> poses;
  std::vector<Matrix6d> covariances;
  odometry.OnPose([&](const ControlPose& pose, const Matrix6d& C) {
    poses.push_back(pose);
    covariances.push_back(C);
  });
  for (int i = 0; i < sweeps; ++i) odometry.AddScan(world.Sweep(i));
  odometry.Finish();
  const auto truth = [&](std::int64_t t_ns) {
    return world.T_world_body(1e-9 * static_cast<double>(t_ns - world.start_ns));
  };
  double sum = 0.0;
  int count = 0;
  for (std::size_t a = 1, b = 1; b < poses.size(); ++b) {
    while (poses[b].t_ns - poses[a + 1].t_ns >= 1'000'000'000) ++a;
    if (poses[b].t_ns - world.start_ns < 1'500'000'000) continue;
    if (poses[b].t_ns - world.start_ns > sweeps * 100'000'000LL - 100'000'000) break;
    const SE3 estimated = poses[a].T_world_body.Inverse() * poses[b].T_world_body;
    const SE3 expected = truth(poses[a].t_ns).Inverse() * truth(poses[b].t_ns);
    const Vector6d e = Minus(expected, estimated);
    const Matrix6d Ad = se3::Adjoint(estimated.Inverse());
    const Matrix6d C = covariances[b] + Ad * covariances[a] * Ad.transpose();
    sum += e.dot(C.ldlt().solve(e)) / 6.0;
    ++count;
  }
  return sum / count;
}

TEST(Odometry, CovariancesAreThoseOfRelativePosesAtRestAndInMotion) {
  SyntheticWorld world;
  // Without calibration it is 0.01 to 0.03 at rest. One run of three seconds tells no more than
  // the order of magnitude.
  const double at_rest = NormalisedErrorOfRelativePoses(world, 30);
  EXPECT_GT(at_rest, 0.1);
  EXPECT_LT(at_rest, 5.0);
  world.T_world_body = StartsAtRest;
  const double in_motion = NormalisedErrorOfRelativePoses(world, 30);
  EXPECT_GT(in_motion, 0.1);
  EXPECT_LT(in_motion, 5.0);
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
      EXPECT_EQ(std::memcmp(a[i].T_world_body.data(), b[i].T_world_body.data(), 56), 0);
    }
    EXPECT_EQ(several.odometry->map().size(), one.odometry->map().size());
  }
}

TEST(Odometry, WhatCallbacksThrowReachesTheCallerAndFinishSettlesTheRest) {
  const SyntheticWorld world;
  OdometryOptions options = RoomOptions();
  for (const int threads : {1, 2}) {
    options.threads = threads;
    Odometry odometry(options);
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
    EXPECT_EQ(failures, (std::vector<std::string>{"bad window", "bad scan"}));
    const std::size_t settled = odometry.trajectory().poses().size();
    odometry.Finish();
    EXPECT_GT(odometry.trajectory().poses().size(), settled);
    ExpectFinite(odometry.trajectory());
  }
}

TEST(Odometry, WorksOnTheKdTreeMapToo) {
  SyntheticWorld world;
  world.T_world_body = StartsAtRest;
  OdometryOptions options = RoomOptions();
  options.map.finest.kind = MapKind::kKdTree;
  const RunResult run = RunOn(world, options, 15);
  EXPECT_LT(LargestError(world, run.odometry->trajectory(), 1.45), 0.03);
}

TEST(Odometry, WorksWithQrMarginalizationAndWithFirstEstimates) {
  SyntheticWorld world;
  world.T_world_body = StartsAtRest;
  OdometryOptions options = RoomOptions();
  options.marginalization.use_qr = true;
  EXPECT_LT(LargestError(world, RunOn(world, options, 15).odometry->trajectory(), 1.45), 0.03);
  options.marginalization.first_estimate_jacobians = true;
  EXPECT_LT(LargestError(world, RunOn(world, options, 15).odometry->trajectory(), 1.45), 0.03);
}

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
    testing::Random random(static_cast<unsigned>(i));
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
    testing::Random random(static_cast<unsigned>(i));
    for (std::size_t k = 0; k < scan->points.size(); ++k) {
      if (k % 5 != 0) scan->points[k].xyz_m = random.Vector(20, 90).cast<float>();
    }
  });
  EXPECT_FALSE(run.odometry->lost_at_ns());
  constexpr double kWindow_s = 0.12;
  for (const ControlPose& pose : run.odometry->trajectory().poses()) {
    const double t_s = 1e-9 * static_cast<double>(pose.t_ns - world.start_ns);
    if (t_s < 3.4) {
      EXPECT_EQ(pose.flags & kFlagFewInliers, 0U) << t_s;
    } else if (t_s > 3.4 + kWindow_s) {
      EXPECT_EQ(pose.flags & kFlagFewInliers, +kFlagFewInliers) << t_s;
    }
  }
}

TEST(Odometry, NothingAndOneScanAreValidRecordings) {
  SyntheticWorld world;
  Odometry nothing(RoomOptions());
  nothing.Finish();
  EXPECT_TRUE(nothing.trajectory().empty());
  const RunResult run = RunOn(world, RoomOptions(), 1);
  ExpectFinite(run.odometry->trajectory());
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
  const RunResult all = RunOn(world, options, 30);
  options.map.finest.radius_m = 6.0;
  const RunResult near = RunOn(world, options, 30);
  EXPECT_LT(near.odometry->map().size(), all.odometry->map().size() * 3 / 4);
}

TEST(Odometry, KeepsItsOwnCopyOfTheOptions) {
  SyntheticWorld world;
  world.T_world_body = StartsAtRest;
  auto options = std::make_unique<OdometryOptions>(RoomOptions());
  Odometry odometry(*options);
  options->window.segments = 1;
  options->lost.min_inlier_share = 1.0;
  options.reset();
  for (int i = 0; i < 10; ++i) odometry.AddScan(world.Sweep(i));
  odometry.Finish();
  EXPECT_LT(LargestError(world, odometry.trajectory(), 0.95), 0.03);
}

}  // namespace
}  // namespace trajlo
