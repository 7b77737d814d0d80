// SPDX-License-Identifier: MIT
#include "core/odometry/solvers/gauss_newton_solver.h"

#include <Eigen/Cholesky>

#include "core/timing/stopwatch.h"

namespace trajlo {

SolveSummary GaussNewtonSolver::Solve(Window* window) {
  const std::vector<SE3> start = window->Poses();
  std::vector<SE3> poses = start;
  SolveSummary summary;
  bool is_small = false;
  while (summary.iterations < options_.iterations_per_round && !is_small) {
    Stopwatch watch;
    evaluator_.Evaluate(window, poses, true, &registration_);
    AssembleWindow(*window, poses, registration_, &equations_);
    summary.costs.push_back(equations_.cost.Total());
    summary.evaluate_s += watch.Seconds();
    const Eigen::VectorXd xi = -equations_.H.ldlt().solve(equations_.g);
    summary.linear_solve_s += watch.Seconds();
    if (!xi.allFinite()) {
      summary.finite = false;
      return summary;
    }
    const std::vector<SE3> before = poses;
    for (std::size_t k = 0; k < poses.size(); ++k) {
      poses[k] = Plus(before[k], xi.segment<6>(6 * static_cast<Eigen::Index>(k)));
    }
    ++summary.iterations;
    is_small = MeasureStep(before, poses).IsWithin(options_.step_tolerance);
  }
  summary.step = MeasureStep(start, poses);
  window->SetPoses(poses);
  ShiftRegistration(window);
  summary.cost = CostWithoutRegistration(*window, poses);
  for (const Segment& segment : window->segments) {
    summary.cost.registration += segment.registration.cost;
  }
  return summary;
}

}  // namespace trajlo
