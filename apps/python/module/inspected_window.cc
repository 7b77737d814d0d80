// SPDX-License-Identifier: MIT
#include "apps/python/module/inspected_window.h"

#include <string>
#include <utility>

#include "apps/python/module/errors.h"
#include "core/comparison/forms/ceres_form_solver.h"

namespace trajlo::python {

InspectedWindow InspectedWindow::Solve(const Reweighing& reweighing, SolverKind kind,
                                       int max_iterations) const {
  SolverOptions options = config_->odometry.solver;
  options.kind = kind;
  SolvedWindow solved =
      SolveToTheEnd(Reweigh(window_, reweighing), MakeSolverFactory(config_->ceres_form), options,
                    max_iterations);
  if (!solved.summary.finite) {
    throw EstimatorError("window " + std::to_string(index_) +
                         " has no finite solution with these weights; they are too large, or "
                         "nothing holds its poses");
  }
  return {index_, std::move(solved.window), config_, std::move(solved.summary)};
}

}  // namespace trajlo::python
