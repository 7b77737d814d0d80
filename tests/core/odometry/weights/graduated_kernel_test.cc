// SPDX-License-Identifier: MIT
#include "core/odometry/weights/graduated_kernel.h"

#include <gtest/gtest.h>

#include "core/odometry/solvers/window_solver.h"
#include "core/odometry/window/associate_window.h"
#include "core/odometry/window/covariance.h"
#include "tests/support/map_points.h"
#include "tests/support/test_window.h"

namespace trajlo {
namespace {

constexpr double kKernel_m = 0.1;

/// A place on the walls of a box about the origin.
Eigen::Vector3d OnWalls(testing::Random* random) {
  const Eigen::Vector3d half_m(8.0, 7.0, 6.0);
  const int across = static_cast<int>(random->Uniform(0.0, 3.0));
  Eigen::Vector3d p = random->PlaceIn(half_m);
  p[across] = p[across] > 0.0 ? half_m[across] : -half_m[across];
  return p;
}

MapPyramid BoxMap() {
  testing::Random random(1);
  std::vector<Eigen::Vector3d> walls;
  for (int i = 0; i < 30000; ++i) walls.push_back(OnWalls(&random));
  MapPyramid map({});
  map.Insert(testing::MapPoints(walls));
  return map;
}

/// One segment of which only the begin is known; its motion is expected to be `expected`, give or
/// take `sigma_m` and `sigma_rad`.
Window OneSegment(const SE3& T_end, const SE3& expected, double sigma_m, double sigma_rad,
                  testing::Random* random) {
  Window window;
  window.prior = MakeAnchor(SE3(), 1e-3, 1e-3);
  window.noise = {0.05, {KernelKind::kCauchy, kKernel_m / 0.05}};
  Segment segment;
  segment.cloud.end_ns = 30'000'000;
  segment.cloud.lidar_origins_body_m = {Eigen::Vector3d::Zero()};
  for (int i = 0; i < 400; ++i) {
    segment.cloud.registration_points.push_back(
        {(T_end.Inverse() * OnWalls(random)).cast<float>(), 1.0F, 0});
  }
  SmoothnessTerm motion;
  motion.tau_expected = se3::Log(expected);
  motion.sqrt_information << Eigen::Vector3d::Constant(1.0 / sigma_m),
      Eigen::Vector3d::Constant(1.0 / sigma_rad);
  segment.motion = motion;
  segment.T_world_end = expected;
  window.segments.push_back(std::move(segment));
  return window;
}

/// The rounds of Odometry, with or without a graduated kernel.
void Estimate(const MapPyramid& map, bool is_graduated, Window* window) {
  ThreadPool threads(1);
  const SolverOptions options;
  const auto solver = MakeWindowSolver(options, &threads);
  GraduatedKernel kernel(*window, kKernel_m);
  Segment* newest = &window->segments.back();
  for (int round = 0; round < 12; ++round) {
    AssociateWindow(map, options.step_tolerance, &threads, window);
    const bool is_widened = is_graduated && kernel.Widen(newest);
    solver->Solve(window);
    if (is_widened) kernel.Restore(newest);
  }
}

TEST(GraduatedKernel, FindsTheMapAgainFromFarOff) {
  const MapPyramid map = BoxMap();
  int found_with = 0, found_without = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    testing::Random random(seed);
    const SE3 truth = se3::Exp(random.Tangent(0.5, 0.3));
    const SE3 expected = Plus(truth, random.Tangent(0.6, 0.12));
    for (const bool is_graduated : {true, false}) {
      testing::Random points(100 + seed);
      Window window = OneSegment(truth, expected, 0.6, 0.12, &points);
      Estimate(map, is_graduated, &window);
      const bool is_found = Minus(window.segments[0].T_world_end, truth).norm() < 0.03;
      (is_graduated ? found_with : found_without) += is_found ? 1 : 0;
    }
  }
  EXPECT_GE(found_with, 20);
  EXPECT_LE(found_without, 4);
}

TEST(GraduatedKernel, WidensEachKernelByHowFarThePredictionMayBeOffThere) {
  const MapPyramid map = BoxMap();
  testing::Random random(3);
  Window window = OneSegment(SE3(), SE3(), 0.3, 0.1, &random);
  const Matrix6d P = PoseCovariance(AssembleWindow(window), 1);
  GraduatedKernel kernel(window, kKernel_m);
  ThreadPool threads(1);
  AssociateWindow(map, {}, &threads, &window);
  Segment& newest = window.segments[0];
  const std::vector<RegistrationPoint> before = newest.points;
  for (int round = 0; round < 3; ++round) {
    ASSERT_TRUE(kernel.Widen(&newest));
    for (std::size_t i = 0; i < before.size(); ++i) {
      // The distance's derivative by finite differences.
      Vector6d J;
      for (int c = 0; c < 6; ++c) {
        const Vector6d step = 1e-6 * Vector6d::Unit(c);
        const Eigen::Vector3d moved = se3::Exp(step) * before[i].p_body_m - before[i].p_body_m;
        J[c] = before[i].normal_world.dot(moved) / 1e-6;
      }
      const double f = 9.0 * std::pow(0.25, round) * J.dot(P * J) / (kKernel_m * kKernel_m);
      const double widened = before[i].weight * std::pow(before[i].coarseness, 3) / (1.0 + f);
      EXPECT_NEAR(newest.points[i].weight, widened, 1e-4 * widened);
    }
    kernel.Restore(&newest);
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_EQ(newest.points[i].weight, before[i].weight);
    }
  }
}

TEST(GraduatedKernel, LeavesAGoodPredictionAlone) {
  const MapPyramid map = BoxMap();
  testing::Random random(4);
  Window window = OneSegment(SE3(), SE3(), 0.01, 0.001, &random);
  GraduatedKernel kernel(window, kKernel_m);
  ThreadPool threads(1);
  AssociateWindow(map, {}, &threads, &window);
  EXPECT_FALSE(kernel.Widen(&window.segments[0]));
}

TEST(GraduatedKernel, EndsAfterAFewRounds) {
  const MapPyramid map = BoxMap();
  testing::Random random(5);
  Window window = OneSegment(SE3(), SE3(), 2.0, 0.5, &random);
  GraduatedKernel kernel(window, kKernel_m);
  ThreadPool threads(1);
  AssociateWindow(map, {}, &threads, &window);
  int rounds = 0;
  for (; rounds < 20 && kernel.Widen(&window.segments[0]); ++rounds) {
    kernel.Restore(&window.segments[0]);
  }
  EXPECT_GT(rounds, 3);
  EXPECT_LT(rounds, 10);
}

}  // namespace
}  // namespace trajlo
