// SPDX-License-Identifier: MIT
#include "core/odometry/window/marginalize.h"

#include <ceres/covariance.h>
#include <ceres/problem.h>
#include <gtest/gtest.h>

#include "core/odometry/solvers/window_solver.h"
#include "core/odometry/window/covariance.h"
#include "core/odometry/window/window_equations.h"
#include "factors/segment_registration.h"
#include "manifolds/se3_manifold.h"
#include "tests/support/test_window.h"

namespace trajlo {
namespace {

using testing::LargestDifference;
using testing::MakeTestWindow;

Window SolvedWindow(unsigned seed) {
  Window window = MakeTestWindow(seed);
  ThreadPool threads(1);
  SolverOptions options;
  options.kind = SolverKind::kGaussNewton;
  options.iterations_per_round = 60;
  options.step_tolerance = {1e-12, 1e-12};
  MakeWindowSolver(options, &threads)->Solve(&window);
  return window;
}

TEST(Marginalize, ThePriorIsOnThePosesThatTheFirstOneSharedATermWith) {
  Window window = SolvedWindow(16);
  Marginalize({}, &window);
  EXPECT_EQ(window.prior.poses(), 2);
}

TEST(Marginalize, TheSmallerWindowHasItsOptimumWhereTheLargerOneHad) {
  for (int left = 1; left <= 3; ++left) {
    Window window = SolvedWindow(17);
    const std::vector<SE3> full = window.Poses();
    for (int i = 0; i < left; ++i) Marginalize({}, &window);
    ThreadPool threads(1);
    SolverOptions options;
    options.iterations_per_round = 60;
    MakeWindowSolver(options, &threads)->Solve(&window);
    EXPECT_LT(LargestDifference(window.Poses(), {full.begin() + left, full.end()}), 1e-7) << left;
  }
}

/// The prior carries the whole of what the leaving terms know: the covariance of the newest pose
/// stays.
TEST(Marginalize, TheCovarianceOfTheNewestPoseStays) {
  Window window = SolvedWindow(18);
  const Matrix6d before = PoseCovariance(AssembleWindow(window), window.size());
  Marginalize({}, &window);
  const Matrix6d after = PoseCovariance(AssembleWindow(window), window.size());
  EXPECT_LT((after - before).norm(), 1e-6 * before.norm());
}

TEST(Marginalize, WhatLeavesIsForgottenIfItIsSwitchedOff) {
  MarginalizationOptions options;
  options.enabled = false;
  Window window = SolvedWindow(19);
  Marginalize(options, &window);
  EXPECT_EQ(window.prior.poses(), 1);
  EXPECT_DOUBLE_EQ(window.prior.sqrt_information(0, 0), 1e3);
}

TEST(Marginalize, AWindowThatIsNotBelievedLeavesNoPullInThePrior) {
  for (const bool is_believed : {true, false}) {
    Window window = MakeTestWindow(20);  // Not solved: its gradient is large.
    window.segments[0].registration =
        LinearizeSegment(window.segments[0].points, window.Pose(0), window.Pose(1),
                         window.NoiseOf(window.segments[0]));
    window.is_believed = is_believed;
    Marginalize({}, &window);
    const MarginalizationPrior& prior = window.prior;
    EXPECT_EQ((prior.sqrt_information.transpose() * prior.offset).norm() > 1.0, is_believed);
    EXPECT_GT(prior.sqrt_information.norm(), 0.0);
  }
}

TEST(Marginalize, TheOldestSegmentIsHandedOutAndTheNextOneIsNoLongerTied) {
  Window window = SolvedWindow(21);
  const SE3 second = window.Pose(1);
  const Vector6d velocity = window.Velocity(0);
  const Segment left = Marginalize({}, &window);
  EXPECT_EQ(left.cloud.end_ns, window.begin_ns);
  EXPECT_EQ(window.T_world_begin.t, second.t);
  EXPECT_LT((window.begin_velocity - velocity).norm(), 1e-12);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(window.segments[0].motion));
  EXPECT_EQ(window.size(), 3);
}

TEST(Covariance, OfAPoseIsThatOfCeres) {
  Window window = MakeTestWindow(16);
  window.noise.kernel.kind = KernelKind::kNone;
  std::vector<SE3> poses = window.Poses();
  SE3Manifold manifold;
  ceres::Problem::Options options;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(options);
  for (SE3& pose : poses) problem.AddParameterBlock(pose.data(), 7, &manifold);
  for (std::size_t k = 0; k < window.segments.size(); ++k) {
    Segment& segment = window.segments[k];
    const RegistrationNoise noise = window.NoiseOf(segment);
    segment.registration = LinearizeSegment(segment.points, poses[k], poses[k + 1], noise);
    problem.AddResidualBlock(new SegmentRegistrationCost(&segment.points, noise), nullptr,
                             poses[k].data(), poses[k + 1].data());
    if (const auto* known = std::get_if<SmoothnessTerm>(&segment.motion)) {
      problem.AddResidualBlock(new SmoothnessCost(known), nullptr, poses[k].data(),
                               poses[k + 1].data());
    } else {
      problem.AddResidualBlock(
          new WhiteNoiseAccelerationCost(&std::get<WhiteNoiseAccelerationTerm>(segment.motion)),
          nullptr, poses[k - 1].data(), poses[k].data(), poses[k + 1].data());
    }
  }
  problem.AddResidualBlock(new MarginalizationPriorCost(&window.prior), nullptr, poses[0].data());
  ceres::Covariance covariance({});
  for (const int k : {0, 2, 4}) {
    const double* block = poses[static_cast<std::size_t>(k)].data();
    const std::vector<std::pair<const double*, const double*>> wanted = {{block, block}};
    ASSERT_TRUE(covariance.Compute(wanted, &problem));
    Eigen::Matrix<double, 6, 6, Eigen::RowMajor> theirs;
    covariance.GetCovarianceBlockInTangentSpace(block, block, theirs.data());
    EXPECT_LT((PoseCovariance(AssembleWindow(window), k) - theirs).norm(), 1e-8 * theirs.norm());
  }
}

TEST(Covariance, OfAWindowThatIsNotHeldIsNotANumber) {
  WindowNormalEquations normal;
  normal.H = Eigen::MatrixXd::Zero(12, 12);
  normal.H.topLeftCorner<3, 3>().setIdentity();
  EXPECT_TRUE(PoseCovariance(normal, 0).array().isNaN().all());
}

}  // namespace
}  // namespace trajlo
