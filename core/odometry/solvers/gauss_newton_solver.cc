// SPDX-License-Identifier: MIT
#include "core/odometry/solvers/gauss_newton_solver.h"

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
    const Eigen::VectorXd xi = SolveNormalEquations(equations_);
    summary.linear_solve_s += watch.Seconds();
    const std::vector<SE3> before = poses;
    summary.finite = TakeStep(xi, &poses);
    if (!summary.finite) return summary;
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
