// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/iteration_callback.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <cstddef>
#include <vector>

#include "core/odometry/solvers/window_solver.h"

namespace trajlo {

/// Ends a Ceres solve as the Gauss-Newton solver ends: after as many steps as are wanted (Ceres's
/// own bound counts rejected ones, too), or after a small one. Keeps the costs.
class StopAfterSteps final : public ceres::IterationCallback {
 public:
  /// Both must outlive it.
  StopAfterSteps(const SolverOptions& options, const std::vector<SE3>* state)
      : options_(options), state_(*state), before_(*state) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& iteration) override;

  /// At the start and after each step that was taken.
  const std::vector<double>& costs() const { return costs_; }
  int rejected() const { return rejected_; }

 private:
  const SolverOptions& options_;
  const std::vector<SE3>& state_;
  std::vector<SE3> before_;
  std::vector<double> costs_;
  int rejected_ = 0;
};

/// Levenberg-Marquardt that begins without damping, so that its steps are those of Gauss-Newton
/// until one raises the cost. For a window of `poses`: dense, or sparse if it is long.
ceres::Solver::Options UndampedSolverOptions(int steps, std::size_t poses);

/// Solves `problem` with `poses`, its parameter blocks, from the poses of the window to which it
/// belongs, and puts these to the solution if it is one.
SolveSummary SolveByCeres(const SolverOptions& options, ceres::Solver::Options ceres_options,
                          std::vector<SE3>* poses, ceres::Problem* problem, Window* window);

}  // namespace trajlo
