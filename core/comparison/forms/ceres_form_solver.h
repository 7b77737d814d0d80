// SPDX-License-Identifier: MIT
#pragma once

#include "core/comparison/forms/ceres_form_options.h"
#include "core/odometry/solvers/window_solver.h"
#include "core/odometry/window/registration_evaluator.h"

namespace trajlo {

/// A window solved by Ceres with another form of the registration, in a problem that is built anew
/// for each solve: for comparison with CeresSolver. Nothing else differs: after a single step it
/// leaves the registration in the segments as CeresSolver does.
class CeresFormSolver final : public WindowSolver {
 public:
  CeresFormSolver(const CeresFormOptions& form, const SolverOptions& options, ThreadPool* threads)
      : form_(form), options_(options), evaluator_(threads, options.step_tolerance) {}

  SolveSummary Solve(Window* window) override;

 private:
  CeresFormOptions form_;
  SolverOptions options_;
  RegistrationEvaluator evaluator_;
};

/// The product's own solvers, with Ceres's options as `form` has them; CeresFormSolver only where
/// the form of the registration is another.
WindowSolverFactory MakeSolverFactory(const CeresFormOptions& form);

}  // namespace trajlo
