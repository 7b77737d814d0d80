// SPDX-License-Identifier: MIT
// The forms in which the registration of a window can enter Ceres, all with analytic or automatic
// Jacobians, solved from the same start (5 iterations, problem built anew), against 5 iterations of
// the hand-rolled Gauss-Newton on the same window. Each case prints that ratio, measured in the
// same run, as `vs_gauss_newton`.
#include <benchmark/benchmark.h>

#include <chrono>

#include "core/comparison/forms/ceres_form_solver.h"
#include "core/odometry/solvers/gauss_newton_solver.h"
#include "tests/benchmarks/benchmark_window.h"

namespace trajlo {
namespace {

constexpr int kIterations = 5;

double Seconds(WindowSolver* solver, const Window& window, int repeats) {
  double seconds = 0.0;
  for (int i = 0; i < repeats; ++i) {
    Window copy = window;
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(solver->Solve(&copy));
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  return seconds / repeats;
}

void CeresForm(benchmark::State& state, RegistrationForm registration) {
  const Window window = MakeBenchmarkWindow(static_cast<int>(state.range(0)));
  ThreadPool threads(1);
  SolverOptions options;
  options.iterations_per_round = kIterations;
  options.step_tolerance = {0.0, 0.0};
  GaussNewtonSolver gauss_newton(options, &threads);
  CeresFormOptions form;
  form.registration = registration;
  CeresFormSolver solver(form, options, &threads);
  double seconds = 0.0;
  for (auto _ : state) seconds += Seconds(&solver, window, 1);
  state.counters["vs_gauss_newton"] =
      seconds / static_cast<double>(state.iterations()) / Seconds(&gauss_newton, window, 20);
}

BENCHMARK_CAPTURE(CeresForm, one_block_a_point_autodiff, RegistrationForm::kPointAutodiff)
    ->Arg(1500)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(CeresForm, one_block_a_point_analytic, RegistrationForm::kPoint)
    ->Arg(1500)
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(CeresForm, one_condensed_block_a_segment, RegistrationForm::kCondensed)
    ->Arg(1500)
    ->Arg(5000)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace trajlo
