// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/solver.h>

#include "core/odometry/solvers/window_solver.h"

namespace trajlo {

/// The window as a Ceres problem: control poses are parameter blocks on SE3Manifold, each segment
/// has one condensed registration block and one smoothness block, the first pose has the prior.
/// An evaluation callback computes the registration of all segments in parallel.
class CeresSolver final : public WindowSolver {
 public:
  CeresSolver(const SolverOptions& options, ThreadPool* threads);

  SolveSummary Solve(WindowProblem* problem) override;

 private:
  SolverOptions options_;
  ceres::Solver::Options solver_options_;
  RegistrationEvaluator evaluator_;
  std::vector<RegistrationNormalEquations> registration_;
};

}  // namespace trajlo
