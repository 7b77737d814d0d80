// SPDX-License-Identifier: MIT
#pragma once

#include "core/comparison/forms/ceres_form_options.h"
#include "core/odometry/solvers/window_solver.h"
#include "core/odometry/window/registration_evaluator.h"

namespace trajlo {

/// A window solved by Ceres in any of its forms, in a problem that is built anew for each solve:
/// for comparison with CeresSolver.
class CeresFormSolver final : public WindowSolver {
 public:
  CeresFormSolver(const CeresFormOptions& form, const SolverOptions& options, ThreadPool* threads)
      : form_(form), options_(options), evaluator_(threads) {}

  SolveSummary Solve(Window* window) override;

 private:
  CeresFormOptions form_;
  SolverOptions options_;
  RegistrationEvaluator evaluator_;
};

/// The product's own solvers where the form is the default or Ceres is not asked for.
WindowSolverFactory MakeSolverFactory(const CeresFormOptions& form);

}  // namespace trajlo
