// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "core/estimation/solver_options.h"
#include "core/estimation/window_problem.h"

namespace trajlo {

struct SolveSummary {
  int iterations = 0;
  WindowCost cost;  ///< At the solution for Ceres, at the last linearisation for Gauss-Newton.
  double step_m = 0.0;    ///< Largest translation of a control pose from start to solution.
  double step_rad = 0.0;  ///< Largest rotation.
  bool finite = true;     ///< False: the poses are those of the start.
  /// The linearised registration at the solution, where the solver happens to have it (Ceres when it
  /// stops before its last iteration); valid until the next solve.
  const std::vector<RegistrationNormalEquations>* registration = nullptr;
};

/// Solves a window with fixed associations. Both solvers minimise the same energy through the same
/// evaluation of the registration, so they end at the same optimum.
class WindowSolver {
 public:
  virtual ~WindowSolver() = default;
  /// At most `options.iterations_per_round` iterations from `problem->poses`.
  virtual SolveSummary Solve(WindowProblem* problem) = 0;
};

std::unique_ptr<WindowSolver> MakeWindowSolver(const SolverOptions& options, ThreadPool* threads);

/// Fills `step_m` and `step_rad` of a summary.
void MeasureStep(const std::vector<SE3>& start, const std::vector<SE3>& solution,
                 SolveSummary* summary);

}  // namespace trajlo
