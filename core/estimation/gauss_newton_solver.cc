// SPDX-License-Identifier: MIT
#include "core/estimation/gauss_newton_solver.h"

#include <Eigen/Cholesky>

namespace trajlo {

SolveSummary GaussNewtonSolver::Solve(WindowProblem* problem) {
  const std::vector<SE3> start = problem->poses;
  SolveSummary summary;
  for (int iteration = 0; iteration < options_.iterations_per_round; ++iteration) {
    evaluator_.Evaluate(*problem, problem->poses, true, &registration_);
    AssembleWindow(*problem, problem->poses, registration_, &window_);
    const Eigen::VectorXd xi = -window_.H.ldlt().solve(window_.g);
    if (!xi.allFinite()) {
      problem->poses = start;
      summary.finite = false;
      return summary;
    }
    double step_m = 0.0;
    double step_rad = 0.0;
    for (std::size_t k = 0; k < problem->poses.size(); ++k) {
      const Vector6d xi_k = xi.segment<6>(6 * static_cast<Eigen::Index>(k));
      problem->poses[k] = Plus(problem->poses[k], xi_k);
      step_m = std::max(step_m, xi_k.head<3>().norm());
      step_rad = std::max(step_rad, xi_k.tail<3>().norm());
    }
    ++summary.iterations;
    if (step_m < options_.step_tolerance_m && step_rad < options_.step_tolerance_rad) break;
  }
  summary.cost = window_.cost;
  MeasureStep(start, problem->poses, &summary);
  return summary;
}

}  // namespace trajlo
