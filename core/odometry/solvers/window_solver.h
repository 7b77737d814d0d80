// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/odometry/solvers/solver_options.h"
#include "core/odometry/solvers/window_problem.h"

namespace trajlo {

/// How far the control poses of a window moved, at most.
struct StepSize {
  double translation_m = 0.0;
  double rotation_rad = 0.0;

  bool IsSmall(const SolverOptions& options) const {
    return translation_m < options.step_tolerance_m && rotation_rad < options.step_tolerance_rad;
  }
};
StepSize MeasureStep(const std::vector<SE3>& start, const std::vector<SE3>& end);

struct SolveSummary {
  int iterations = 0;  ///< Steps that were taken.
  /// Steps that Ceres did not take because they raise the cost; Gauss-Newton takes those, too.
  int rejected_steps = 0;
  WindowCost cost;     ///< At the solution for Ceres, at the last linearisation for Gauss-Newton.
  StepSize step;       ///< From start to solution.
  bool finite = true;  ///< False: the poses are those of the start.
  /// The total cost at the start and after each step that was taken; Gauss-Newton does not compute
  /// that of its last one.
  std::vector<double> costs;
  double evaluate_s = 0.0;      ///< Time spent on residuals and Jacobians.
  double linear_solve_s = 0.0;  ///< Time spent on the linear equations.
  /// The linearised registration at the solution, where the solver happens to have it (Ceres when
  /// it stops before its last iteration); valid until the next solve.
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

/// Makes the solver of an odometry; for studies that put one of their own in place.
using WindowSolverFactory =
    std::function<std::unique_ptr<WindowSolver>(const SolverOptions&, ThreadPool*)>;

}  // namespace trajlo
