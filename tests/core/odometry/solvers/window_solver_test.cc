// SPDX-License-Identifier: MIT
#include "core/odometry/solvers/window_solver.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/odometry/solvers/ceres_steps.h"
#include "core/odometry/window/marginalize.h"
#include "core/odometry/window/registration_evaluator.h"
#include "tests/support/test_window.h"

namespace trajlo {
namespace {

using testing::LargestDifference;
using testing::MakeTestWindow;
using testing::Random;

SolverOptions Converging(SolverKind kind) {
  SolverOptions options;
  options.kind = kind;
  options.iterations_per_round = 60;
  options.step_tolerance = {1e-11, 1e-11};
  return options;
}

std::vector<SE3> Solve(const SolverOptions& options, Window window) {
  ThreadPool threads(2);
  const SolveSummary summary = MakeWindowSolver(options, &threads)->Solve(&window);
  EXPECT_TRUE(summary.finite);
  return window.Poses();
}

/// A window whose prior ties two poses: one segment has left it.
Window WindowInTheMidst(unsigned seed) {
  Window window = MakeTestWindow(seed);
  ThreadPool threads(1);
  MakeWindowSolver(Converging(SolverKind::kGaussNewton), &threads)->Solve(&window);
  Marginalize({}, &window);
  Random random(seed);
  std::vector<SE3> poses = window.Poses();
  for (SE3& pose : poses) pose = Plus(pose, random.Tangent(0.01, 0.02));
  window.SetPoses(poses);
  return window;
}

TEST(WindowSolver, CeresAndGaussNewtonEndAtTheSameOptimum) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    for (const Window& window : {MakeTestWindow(seed), WindowInTheMidst(seed)}) {
      const auto expected = Solve(Converging(SolverKind::kGaussNewton), window);
      EXPECT_LT(LargestDifference(Solve(Converging(SolverKind::kCeres), window), expected), 1e-7);
    }
  }
}

TEST(WindowSolver, CeresIsSparseInLongWindowsOnly) {
  EXPECT_EQ(UndampedSolverOptions(1, 5).linear_solver_type, ceres::DENSE_NORMAL_CHOLESKY);
  EXPECT_EQ(UndampedSolverOptions(1, 51).linear_solver_type, ceres::SPARSE_NORMAL_CHOLESKY);
}

/// Both use a sparse factorisation there.
TEST(WindowSolver, CeresAndGaussNewtonAgreeInALongWindow) {
  const Window window = MakeTestWindow(1, 60, 50);
  const auto expected = Solve(Converging(SolverKind::kGaussNewton), window);
  EXPECT_LT(LargestDifference(Solve(Converging(SolverKind::kCeres), window), expected), 1e-7);
}

TEST(WindowSolver, OneCeresIterationIsOneGaussNewtonStep) {
  for (const Window& window : {MakeTestWindow(12), WindowInTheMidst(12)}) {
    SolverOptions options = Converging(SolverKind::kGaussNewton);
    options.iterations_per_round = 1;
    const auto expected = Solve(options, window);
    options.kind = SolverKind::kCeres;
    EXPECT_LT(LargestDifference(Solve(options, window), expected), 1e-6);
  }
}

/// Windows of different structure take turns in one solver.
TEST(WindowSolver, TheLivingProblemFollowsTheWindow) {
  ThreadPool threads(1);
  const auto ceres = MakeWindowSolver(Converging(SolverKind::kCeres), &threads);
  Window shorter = MakeTestWindow(5);
  shorter.segments.pop_back();
  for (const Window& start : {MakeTestWindow(3), MakeTestWindow(4), WindowInTheMidst(3), shorter,
                              WindowInTheMidst(6), MakeTestWindow(3)}) {
    Window window = start;
    ceres->Solve(&window);
    const auto expected = Solve(Converging(SolverKind::kGaussNewton), start);
    EXPECT_LT(LargestDifference(window.Poses(), expected), 1e-7);
  }
}

/// Both solvers leave the registration at the solution to first order in the last step.
TEST(WindowSolver, TheRegistrationIsLeftAtTheSolution) {
  for (const SolverKind kind : {SolverKind::kGaussNewton, SolverKind::kCeres}) {
    for (const int iterations : {1, 60}) {
      Window window = MakeTestWindow(17);
      ThreadPool threads(1);
      MakeWindowSolver(Converging(kind), &threads)->Solve(&window);
      Random random(1);
      std::vector<SE3> poses = window.Poses();
      for (SE3& pose : poses) pose = Plus(pose, random.Tangent(1e-5, 1e-5));
      window.SetPoses(poses);
      SolverOptions options = Converging(kind);
      options.iterations_per_round = iterations;
      MakeWindowSolver(options, &threads)->Solve(&window);
      std::vector<RegistrationNormalEquations> exact;
      RegistrationEvaluator(&threads).Evaluate(&window, window.Poses(), true, &exact);
      for (std::size_t k = 0; k < exact.size(); ++k) {
        const RegistrationNormalEquations& left = window.segments[k].registration;
        EXPECT_LT((left.H - exact[k].H).norm(), 1e-3 * exact[k].H.norm());
        // The step changes the gradient by about |H| 2e-5; kernels make that inexact.
        EXPECT_LT((left.g - exact[k].g).norm(), 2e-6 * exact[k].H.norm());
      }
    }
  }
}

TEST(WindowSolver, ResultsAreTheSameBitsForAnyNumberOfThreads) {
  for (SolverKind kind : {SolverKind::kGaussNewton, SolverKind::kCeres}) {
    Window one = MakeTestWindow(14, 2000), two = one;
    ThreadPool one_thread(1), two_threads(2);
    MakeWindowSolver(Converging(kind), &one_thread)->Solve(&one);
    MakeWindowSolver(Converging(kind), &two_threads)->Solve(&two);
    for (int k = 0; k <= one.size(); ++k) {
      EXPECT_EQ(one.Pose(k).q.coeffs(), two.Pose(k).q.coeffs());
      EXPECT_EQ(one.Pose(k).t, two.Pose(k).t);
    }
  }
}

TEST(WindowSolver, ASegmentWithoutPointsKeepsTheVelocityOfTheOneBefore) {
  for (SolverKind kind : {SolverKind::kGaussNewton, SolverKind::kCeres}) {
    Window window = MakeTestWindow(15);
    window.segments[3].points.clear();
    ThreadPool threads(1);
    EXPECT_TRUE(MakeWindowSolver(Converging(kind), &threads)->Solve(&window).finite);
    EXPECT_LT((window.Velocity(3) - window.Velocity(2)).norm(), 1e-6);
  }
}

TEST(WindowSolver, WhatIsNotFiniteLeavesThePosesAndSaysSo) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (SolverKind kind : {SolverKind::kGaussNewton, SolverKind::kCeres}) {
    for (int iterations : {1, 4}) {
      Window window = MakeTestWindow(16);
      window.segments[2].points[7].normal_world.y() = kNan;
      const std::vector<SE3> start = window.Poses();
      SolverOptions options = Converging(kind);
      options.iterations_per_round = iterations;
      ThreadPool threads(1);
      EXPECT_FALSE(MakeWindowSolver(options, &threads)->Solve(&window).finite);
      EXPECT_LT(LargestDifference(window.Poses(), start), 1e-15);
      for (const SE3& pose : window.Poses()) EXPECT_TRUE(pose.IsFinite());
    }
  }
}

}  // namespace
}  // namespace trajlo
