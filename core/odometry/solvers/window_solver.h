// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "core/odometry/parallel/thread_pool.h"
#include "core/odometry/solvers/solver_options.h"
#include "core/odometry/window/window.h"
#include "core/odometry/window/window_equations.h"

namespace trajlo {

struct SolveSummary {
  int iterations = 0;      ///< Steps that were taken.
  int rejected_steps = 0;  ///< Steps that Ceres did not take because they raise the cost.
  WindowCost cost;         ///< At the solution; the registration's to first order in the last step.
  StepSize step;           ///< From start to solution.
  bool finite = true;      ///< False: the poses are those of the start.
  /// The total cost at the start and after each step that was taken; Gauss-Newton does not compute
  /// that of its last one.
  std::vector<double> costs;
  double evaluate_s = 0.0;      ///< Time spent on residuals and Jacobians.
  double linear_solve_s = 0.0;  ///< Time spent on the linear equations.
};

/// Solves a window with fixed associations. All solvers minimise the same energy.
class WindowSolver {
 public:
  virtual ~WindowSolver() = default;
  /// At most `options.iterations_per_round` steps from the window's poses. Leaves the solution in
  /// its poses, and the registration around them in its segments.
  virtual SolveSummary Solve(Window* window) = 0;
};

std::unique_ptr<WindowSolver> MakeWindowSolver(const SolverOptions& options, ThreadPool* threads);

/// Makes the solver of an odometry; for studies with solvers of their own.
using WindowSolverFactory =
    std::function<std::unique_ptr<WindowSolver>(const SolverOptions&, ThreadPool*)>;

}  // namespace trajlo
