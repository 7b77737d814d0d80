// SPDX-License-Identifier: MIT
// A whole window with fixed associations as the odometry uses it: ten solves of five iterations
// each by a solver of the product on one thread, whose Ceres problem lives from solve to solve. The
// Ceres case prints its ratio to Gauss-Newton, measured in the same run.
#include <benchmark/benchmark.h>

#include <chrono>

#include "core/odometry/solvers/window_solver.h"
#include "tests/benchmarks/benchmark_window.h"

namespace trajlo {
namespace {

double SecondsPerSolve(const Window& window, SolverKind kind, int repeats) {
  ThreadPool threads(1);
  SolverOptions options;
  options.kind = kind;
  options.iterations_per_round = 5;
  options.step_tolerance = {0.0, 0.0};
  const auto solver = MakeWindowSolver(options, &threads);
  double seconds = 0.0;
  for (int i = 0; i < repeats; ++i) {
    Window copy = window;
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(solver->Solve(&copy));
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return seconds / repeats;
}

void SolveWindow(benchmark::State& state, SolverKind kind) {
  const Window window = MakeBenchmarkWindow(static_cast<int>(state.range(0)));
  double seconds = 0.0;
  for (auto _ : state) seconds += SecondsPerSolve(window, kind, 10) * 10.0;
  if (kind == SolverKind::kCeres) {
    state.counters["ceres_vs_gauss_newton"] = seconds /
                                              static_cast<double>(10 * state.iterations()) /
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
