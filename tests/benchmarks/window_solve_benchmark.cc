// SPDX-License-Identifier: MIT
// A whole window with fixed associations as the odometry uses it: five iterations of a solver of
// the product on one thread, then the registration linearised at the solution (for marginalisation
// and for the window's condition). The Ceres case prints its ratio to Gauss-Newton, measured in the
// same run.
#include <benchmark/benchmark.h>

#include <chrono>

#include "core/odometry/solvers/window_solver.h"
#include "tests/benchmarks/benchmark_window.h"

namespace trajlo {
namespace {

double SecondsPerSolve(const BenchmarkWindow& window, SolverKind kind, int repeats) {
  ThreadPool threads(1);
  SolverOptions options;
  options.kind = kind;
  options.iterations_per_round = 5;
  options.step_tolerance_m = options.step_tolerance_rad = 0.0;
  options.ceres.function_tolerance = 0.0;
  options.ceres.gradient_tolerance = 0.0;
  options.ceres.parameter_tolerance = 0.0;
  const auto solver = MakeWindowSolver(options, &threads);
  RegistrationEvaluator evaluator(&threads);
  std::vector<RegistrationNormalEquations> registration;
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < repeats; ++i) {
    WindowProblem problem = window.problem;
    const SolveSummary summary = solver->Solve(&problem);
    if (summary.registration == nullptr) {
      evaluator.Evaluate(problem, problem.poses, true, &registration);
    }
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / repeats;
}

void SolveWindow(benchmark::State& state, SolverKind kind) {
  const BenchmarkWindow window(static_cast<int>(state.range(0)));
  double seconds = 0.0;
  for (auto _ : state) seconds += SecondsPerSolve(window, kind, 1);
  if (kind == SolverKind::kCeres) {
    state.counters["ceres_vs_gauss_newton"] = seconds / static_cast<double>(state.iterations()) /
                                              SecondsPerSolve(window, SolverKind::kGaussNewton, 50);
  }
}
BENCHMARK_CAPTURE(SolveWindow, gauss_newton, SolverKind::kGaussNewton)
    ->Arg(1500)
    ->Arg(5000)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(SolveWindow, ceres, SolverKind::kCeres)
    ->Arg(1500)
    ->Arg(5000)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace trajlo
