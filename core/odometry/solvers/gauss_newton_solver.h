// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/solvers/window_solver.h"
#include "core/odometry/window/registration_evaluator.h"

namespace trajlo {

/// The paper's solver: H xi = -g by dense Cholesky, T_k ← T_k ⊕ xi_k, no damping, no line search.
class GaussNewtonSolver final : public WindowSolver {
 public:
  GaussNewtonSolver(const SolverOptions& options, ThreadPool* threads)
      : options_(options), evaluator_(threads, options.step_tolerance) {}

  SolveSummary Solve(Window* window) override;

 private:
  SolverOptions options_;
  RegistrationEvaluator evaluator_;
  std::vector<RegistrationNormalEquations> registration_;
  WindowNormalEquations equations_;
};

}  // namespace trajlo
