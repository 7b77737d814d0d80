// SPDX-License-Identifier: MIT
#include "core/graph/window_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/scans/median.h"
#include "factors/point_to_plane.h"
#include "tests/core/graph/solved_windows.h"

namespace trajlo {
namespace {

using testing::SolvedWindows;

/// The sum of all factors, each by its own residual and Jacobian, as the paper writes them.
WindowNormalEquations SumOfFactors(const Window& window, const WindowGraph& graph) {
  WindowNormalEquations sum;
  sum.SetZero(window.size() + 1);
  for (const PointFactor& factor : graph.points) {
    Eigen::Matrix<double, 1, 12> J;
    // With unit information the residual is the distance.
    RegistrationPoint point = factor.point;
    point.weight = 1.0;
    const double distance_m = EvaluatePointToPlane(point, 1.0, window.Pose(factor.segment),
                                                   window.Pose(factor.segment + 1), &J);
    EXPECT_NEAR(distance_m, factor.distance_m, 1e-9);
    const double root = std::sqrt(factor.information);
    sum.Add(factor.segment, root * J, Eigen::VectorXd::Constant(1, root * distance_m));
  }
  for (const LinearizedMotion& motion : graph.motion) {
    if (motion.count == 0) continue;
    sum.Add(motion.first, motion.jacobian.leftCols(6 * motion.count), motion.residual);
  }
  sum.Add(0, graph.prior.jacobian, graph.prior.residual);
  return sum;
}

TEST(WindowGraph, ItsFactorsAddUpToItsNormalEquationsAndCosts) {
  for (const Window& window : SolvedWindows()) {
    const WindowGraph graph = MakeWindowGraph(window);
    const WindowNormalEquations sum = SumOfFactors(window, graph);
    const double scale = graph.equations.H.norm();
    EXPECT_LT((sum.H - graph.equations.H).norm(), 1e-9 * scale);
    EXPECT_LT((sum.g - graph.equations.g).norm(), 1e-9 * scale);
    double registration = 0.0;
    for (const PointFactor& factor : graph.points) {
      const RegistrationNoise noise = window.NoiseOf(window.At(factor.segment));
      const double r = factor.distance_m / noise.sigma_m;
      registration += 0.5 * noise.KernelOf(factor.point.axis).Rho(factor.point.weight * r * r);
    }
    const WindowCost& cost = graph.equations.cost;
    EXPECT_NEAR(registration, cost.registration, 1e-9 * (1.0 + cost.registration));
    EXPECT_NEAR(0.5 * graph.prior.residual.squaredNorm(), cost.prior, 1e-12);
  }
}

/// The estimator stops where steps are small, and evaluates to first order: what is left to the
/// minimum must be less than the tolerance of its rounds.
TEST(WindowGraph, AnEstimatedWindowIsNearItsMinimum) {
  const std::vector<Window> windows = SolvedWindows();
  ASSERT_GT(windows.size(), 10u);
  for (const Window& window : windows) {
    const Eigen::VectorXd step = SolveNormalEquations(MakeWindowGraph(window).equations);
    EXPECT_LT(step.lpNorm<Eigen::Infinity>(), 5e-3);
  }
}

TEST(WindowGraph, PointsAreMeasuredWithinTheirSegmentsAndLieOnPlanes) {
  const Window window = SolvedWindows().back();
  const WindowGraph graph = MakeWindowGraph(window);
  ASSERT_EQ(graph.segments.size(), 5u);
  ASSERT_GT(graph.points.size(), 500u);
  std::vector<int> counts(graph.segments.size());
  std::vector<double> distances_m;
  for (const PointFactor& factor : graph.points) {
    const SegmentCloud& cloud = window.At(factor.segment).cloud;
    EXPECT_GE(factor.t_ns, cloud.begin_ns);
    EXPECT_LE(factor.t_ns, cloud.end_ns);
    EXPECT_GT(factor.kernel_weight, 0.0);
    EXPECT_LE(factor.kernel_weight, 1.0);
    ++counts[static_cast<std::size_t>(factor.segment)];
    distances_m.push_back(std::abs(factor.distance_m));
  }
  for (std::size_t k = 0; k < counts.size(); ++k) EXPECT_EQ(counts[k], graph.segments[k].points);
  // The LiDAR has 1 cm of noise, and so has the map.
  EXPECT_LT(LowerMedian(std::move(distances_m)), 0.015);
}

TEST(WindowGraph, AKernelThatIsNotFittedHasItsWidthInAllDirections) {
  OdometryOptions options;
  options.registration.kernel_in_spreads = 0.0;
  options.registration.kernel_m = 0.15;
  const Window window = SolvedWindows(options).back();
  for (const SegmentFactors& segment : MakeWindowGraph(window).segments) {
    for (const double width_m : segment.kernel_m) EXPECT_NEAR(width_m, 0.15, 1e-12);
    EXPECT_GE(segment.sigma_m, 0.03 * std::sqrt(5.0) - 1e-12);
  }
}

}  // namespace
}  // namespace trajlo
