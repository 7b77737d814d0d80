// SPDX-License-Identifier: MIT
// The forms in which the registration of a window can enter Ceres, all with analytic or automatic
// Jacobians, solved from the same start with the same Ceres settings (5 iterations,
// DENSE_NORMAL_CHOLESKY), against 5 iterations of the hand-rolled Gauss-Newton on the same window
// and the evaluation of its last step, which Ceres includes. Each case prints that ratio, measured
// in the same run, as `vs_gauss_newton`.
#include <benchmark/benchmark.h>
#include <ceres/autodiff_cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <chrono>

#include "core/odometry/solvers/gauss_newton_solver.h"
#include "factors/point_to_plane.h"
#include "manifolds/se3_manifold.h"
#include "tests/benchmarks/benchmark_window.h"
#include "tests/support/autodiff_twins.h"

namespace trajlo {
namespace {

enum class Form { kPointAutodiff, kPointAnalytic, kSegmentCondensed };

constexpr int kIterations = 5;

double GaussNewtonSeconds(const BenchmarkWindow& window) {
  ThreadPool threads(1);
  SolverOptions options;
  options.iterations_per_round = kIterations;
  options.step_tolerance_m = options.step_tolerance_rad = 0.0;
  GaussNewtonSolver solver(options, &threads);
  RegistrationEvaluator evaluator(&threads);
  std::vector<RegistrationNormalEquations> registration;
  constexpr int kRepeats = 20;
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < kRepeats; ++i) {
    WindowProblem problem = window.problem;
    benchmark::DoNotOptimize(solver.Solve(&problem));
    evaluator.Evaluate(problem, problem.poses, true, &registration);
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / kRepeats;
}

void SolveWithForm(const BenchmarkWindow& window, Form form) {
  SE3Manifold manifold;
  RobustKernelLoss loss(window.problem.noise.kernel);
  ceres::Problem::Options options;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.disable_all_safety_checks = true;
  ceres::Problem problem(options);
  std::vector<SE3> poses = window.problem.poses;
  for (SE3& pose : poses) problem.AddParameterBlock(pose.data(), 7, &manifold);
  for (int k = 0; k < 4; ++k) {
    double* begin = poses[k].data();
    double* end = poses[k + 1].data();
    if (form == Form::kSegmentCondensed) {
      problem.AddResidualBlock(
          new SegmentRegistrationCost(&window.storage[k], window.problem.noise), nullptr, begin,
          end);
    } else {
      for (const RegistrationPoint& point : window.storage[k]) {
        ceres::CostFunction* factor = nullptr;
        if (form == Form::kPointAnalytic) {
          factor = new PointToPlaneCost(point, window.problem.noise.sigma_m);
        } else {
          factor = new ceres::AutoDiffCostFunction<testing::PointToPlaneTwin, 1, 7, 7>(
              new testing::PointToPlaneTwin{point, window.problem.noise.sigma_m});
        }
        problem.AddResidualBlock(factor, &loss, begin, end);
      }
    }
    problem.AddResidualBlock(new SmoothnessCost(window.problem.smoothness[k]), nullptr, begin, end);
  }
  problem.AddResidualBlock(new MarginalizationPriorCost(window.problem.prior, false), nullptr,
                           poses[0].data());
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = kIterations;
  solver.function_tolerance = solver.gradient_tolerance = solver.parameter_tolerance = 0.0;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  benchmark::DoNotOptimize(summary.final_cost);
}

void CeresForm(benchmark::State& state, Form form) {
  const BenchmarkWindow window(static_cast<int>(state.range(0)));
  const double gauss_newton_s = GaussNewtonSeconds(window);
  const auto start = std::chrono::steady_clock::now();
  for (auto _ : state) SolveWithForm(window, form);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  state.counters["vs_gauss_newton"] =
      seconds / static_cast<double>(state.iterations()) / gauss_newton_s;
}

BENCHMARK_CAPTURE(CeresForm, one_block_a_point_autodiff, Form::kPointAutodiff)
    ->Arg(1500)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(CeresForm, one_block_a_point_analytic, Form::kPointAnalytic)
    ->Arg(1500)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(CeresForm, one_condensed_block_a_segment, Form::kSegmentCondensed)
    ->Arg(1500)
    ->Arg(5000)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace trajlo
