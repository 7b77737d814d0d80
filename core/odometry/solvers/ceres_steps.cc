// SPDX-License-Identifier: MIT
#include "core/odometry/solvers/ceres_steps.h"

#include <ceres/types.h>

#include <algorithm>

#include "core/odometry/window/window_equations.h"

namespace trajlo {
namespace {

/// From no damping to a step that is short enough, Levenberg-Marquardt needs about this many tries.
constexpr int kMostRejectedSteps = 12;

}  // namespace

ceres::CallbackReturnType StopAfterSteps::operator()(const ceres::IterationSummary& iteration) {
  if (iteration.iteration == 0) {
    costs_.push_back(iteration.cost);
    return ceres::SOLVER_CONTINUE;
  }
  if (!iteration.step_is_successful) {
    ++rejected_;
    return ceres::SOLVER_CONTINUE;
  }
  costs_.push_back(iteration.cost);
  const bool is_done = static_cast<int>(costs_.size()) > options_.iterations_per_round ||
                       MeasureStep(before_, state_).IsWithin(options_.step_tolerance);
  before_ = state_;
  return is_done ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
}

ceres::Solver::Options UndampedSolverOptions(int steps, std::size_t poses) {
  ceres::Solver::Options options;
  const bool is_sparse = poses > kLongWindow && ceres::IsSparseLinearAlgebraLibraryTypeAvailable(
                                                    options.sparse_linear_algebra_library_type);
  options.linear_solver_type =
      is_sparse ? ceres::SPARSE_NORMAL_CHOLESKY : ceres::DENSE_NORMAL_CHOLESKY;
  options.initial_trust_region_radius = 1e16;
  options.max_num_iterations = steps + kMostRejectedSteps;
  // Below these Ceres computes a step and does not take it; the rounds end by the size of steps.
  options.function_tolerance = 1e-14;
  options.gradient_tolerance = 0.0;
  options.parameter_tolerance = 0.0;
  options.update_state_every_iteration = true;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  return options;
}

SolveSummary SolveByCeres(const SolverOptions& options, ceres::Solver::Options ceres_options,
                          std::vector<SE3>* poses, ceres::Problem* problem, Window* window) {
  const std::vector<SE3> start = window->Poses();
  // In place: the blocks must stay where they are.
  std::copy(start.begin(), start.end(), poses->begin());
  StopAfterSteps stop(options, poses);
  ceres_options.callbacks = {&stop};
  ceres::Solver::Summary ceres_summary;
  ceres::Solve(ceres_options, problem, &ceres_summary);

  SolveSummary summary;
  summary.costs = stop.costs();
  summary.iterations = std::max(0, static_cast<int>(stop.costs().size()) - 1);
  summary.rejected_steps = stop.rejected();
  summary.evaluate_s = ceres_summary.residual_evaluation_time_in_seconds +
                       ceres_summary.jacobian_evaluation_time_in_seconds;
  summary.linear_solve_s = ceres_summary.linear_solver_time_in_seconds;
  summary.finite = ceres_summary.IsSolutionUsable();
  for (const SE3& pose : *poses) summary.finite = summary.finite && pose.IsFinite();
  if (!summary.finite) return summary;
  summary.step = MeasureStep(start, *poses);
  window->SetPoses(*poses);
  summary.cost = CostWithoutRegistration(*window, *poses);
  summary.cost.registration = ceres_summary.final_cost - summary.cost.Total();
  return summary;
}

}  // namespace trajlo
