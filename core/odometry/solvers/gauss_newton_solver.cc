// SPDX-License-Identifier: MIT
#include "core/odometry/solvers/gauss_newton_solver.h"

#include <Eigen/Cholesky>

#include "core/odometry/stopwatch.h"

namespace trajlo {

SolveSummary GaussNewtonSolver::Solve(WindowProblem* problem) {
  const std::vector<SE3> start = problem->poses;
  SolveSummary summary;
  for (int iteration = 0; iteration < options_.iterations_per_round; ++iteration) {
    Stopwatch watch;
    evaluator_.Evaluate(*problem, problem->poses, true, &registration_);
    AssembleWindow(*problem, problem->poses, registration_, &window_);
    summary.costs.push_back(window_.cost.Total());
    summary.evaluate_s += watch.Seconds();
    const Eigen::VectorXd xi = -window_.H.ldlt().solve(window_.g);
    summary.linear_solve_s += watch.Seconds();
    if (!xi.allFinite()) {
      problem->poses = start;
      summary.finite = false;
      return summary;
    }
    const std::vector<SE3> before = problem->poses;
    for (std::size_t k = 0; k < problem->poses.size(); ++k) {
      const Vector6d xi_k = xi.segment<6>(6 * static_cast<Eigen::Index>(k));
      problem->poses[k] = Plus(before[k], xi_k);
    }
    ++summary.iterations;
    if (MeasureStep(before, problem->poses).IsSmall(options_)) break;
  }
  summary.cost = window_.cost;
  summary.step = MeasureStep(start, problem->poses);
  return summary;
}

}  // namespace trajlo
