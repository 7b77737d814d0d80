// SPDX-License-Identifier: MIT
#include "core/graph/reweigh.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "core/graph/window_graph.h"
#include "tests/core/graph/solved_windows.h"

namespace trajlo {
namespace {

using testing::SolvedWindows;

SolverOptions Of(SolverKind kind) {
  SolverOptions options;
  options.kind = kind;
  return options;
}

SolvedWindow Solve(const Window& window, SolverKind kind = SolverKind::kGaussNewton) {
  return SolveToTheEnd(window, MakeWindowSolver, Of(kind), 100);
}

double Apart_m(const Window& a, const Window& b) {
  return MeasureStep(a.Poses(), b.Poses()).translation_m;
}

double Gradient(const Window& window) {
  const WindowNormalEquations equations = MakeWindowGraph(window).equations;
  return SolveNormalEquations(equations).lpNorm<Eigen::Infinity>();
}

TEST(Reweigh, WithoutChangesTheWindowIsTheSame) {
  const Window window = SolvedWindows().back();
  const WindowGraph before = MakeWindowGraph(window);
  const WindowGraph after = MakeWindowGraph(Reweigh(window, {}));
  EXPECT_EQ(before.equations.H, after.equations.H);
  EXPECT_EQ(before.equations.g, after.equations.g);
  Reweighing same;
  for (const PointFactor& factor : before.points) same.point_weights.push_back(factor.point.weight);
  same.sigma_m = window.noise.sigma_m;
  same.kernel = window.noise.kernel.kind;
  same.prior_factor = 1.0;
  const WindowGraph restated = MakeWindowGraph(Reweigh(window, same));
  EXPECT_EQ(before.equations.H, restated.equations.H);
}

TEST(Reweigh, BothSolversEndAtTheMinimumOfTheNewWeights) {
  const Window window = SolvedWindows().back();
  std::vector<Reweighing> all(5);
  all[0].sigma_m = 0.2;
  all[1].kernel = KernelKind::kHuber;
  all[1].kernel_m = 0.03;
  all[2].translation_m2_s3 = 1e-3;
  all[3].rotation_rad2_s3 = 50.0;
  all[4].prior_factor = 0.1;
  for (const Reweighing& reweighing : all) {
    const Window changed = Reweigh(window, reweighing);
    const SolvedWindow gauss_newton = Solve(changed);
    const SolvedWindow ceres = Solve(changed, SolverKind::kCeres);
    EXPECT_LT(Gradient(gauss_newton.window), 1e-8);
    EXPECT_LT(Apart_m(gauss_newton.window, ceres.window), 1e-7);
    // They are other weights.
    EXPECT_GT(Apart_m(gauss_newton.window, Solve(window).window), 1e-6);
  }
}

TEST(Reweigh, APointWithoutWeightIsAsIfItWereNotThere) {
  const Window window = SolvedWindows().back();
  Reweighing reweighing;
  Window without = window;
  for (Segment& segment : without.segments) {
    std::vector<RegistrationPoint> kept;
    for (std::size_t i = 0; i < segment.points.size(); ++i) {
      const bool is_kept = i % 3 != 0;
      reweighing.point_weights.push_back(is_kept ? segment.points[i].weight : 0.0);
      if (is_kept) kept.push_back(segment.points[i]);
    }
    segment.points = kept;
  }
  const WindowGraph silenced = MakeWindowGraph(Reweigh(window, reweighing));
  const WindowGraph removed = MakeWindowGraph(without);
  EXPECT_LT((silenced.equations.H - removed.equations.H).norm(),
            1e-12 * removed.equations.H.norm());
  EXPECT_NEAR(silenced.equations.cost.Total(), removed.equations.cost.Total(), 1e-9);
}

/// All information times a constant: the same minimum.
TEST(Reweigh, OnlyRatiosOfWeightsMatter) {
  OdometryOptions options;
  options.registration.kernel = KernelKind::kNone;
  options.motion_prior.self_tuning = false;
  const Window window = Reweigh(SolvedWindows(options).back(), {});
  Window plain = window;
  for (Segment& segment : plain.segments) segment.bend_m2 = 0.0;  // It has a sigma of its own.
  Reweighing ten_times;
  ten_times.sigma_m = plain.noise.sigma_m / std::sqrt(10.0);
  ten_times.translation_m2_s3 = options.motion_prior.translation_m2_s3 / 10.0;
  ten_times.rotation_rad2_s3 = options.motion_prior.rotation_rad2_s3 / 10.0;
  ten_times.prior_factor = 10.0;
  const WindowNormalEquations once = MakeWindowGraph(plain).equations;
  const WindowNormalEquations tenfold = MakeWindowGraph(Reweigh(plain, ten_times)).equations;
  EXPECT_LT((tenfold.H - 10.0 * once.H).norm(), 1e-9 * tenfold.H.norm());
  EXPECT_LT(Apart_m(Solve(plain).window, Solve(Reweigh(plain, ten_times)).window), 1e-8);
}

TEST(Reweigh, APseudoVelocityIsTiedByDensitiesToo) {
  OdometryOptions options;
  options.motion_prior.kind = MotionPriorKind::kPseudoVelocity;
  options.motion_prior.self_tuning = false;
  const Window window = SolvedWindows(options).back();
  Reweighing same;
  same.translation_m2_s3 = options.motion_prior.translation_m2_s3;
  same.rotation_rad2_s3 = options.motion_prior.rotation_rad2_s3;
  const Eigen::MatrixXd H = MakeWindowGraph(window).equations.H;
  EXPECT_LT((MakeWindowGraph(Reweigh(window, same)).equations.H - H).norm(), 1e-9 * H.norm());
  same.translation_m2_s3 = 1e-4;
  EXPECT_GT((MakeWindowGraph(Reweigh(window, same)).equations.H - H).norm(), 1e-3 * H.norm());
}

TEST(Reweigh, RefusesWhatIsNoWeight) {
  const Window window = SolvedWindows().back();
  const auto refused = [&](const Reweighing& reweighing) {
    EXPECT_THROW(Reweigh(window, reweighing), std::invalid_argument);
  };
  for (const double wrong : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
    Reweighing reweighing;
    reweighing.sigma_m = wrong;
    refused(reweighing);
    reweighing = {};
    reweighing.rotation_rad2_s3 = wrong;
    refused(reweighing);
  }
  Reweighing reweighing;
  reweighing.prior_factor = -1.0;
  refused(reweighing);
  reweighing = {};
  reweighing.point_weights = {1.0};
  refused(reweighing);
}

}  // namespace
}  // namespace trajlo
