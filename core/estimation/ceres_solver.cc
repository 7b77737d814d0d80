// SPDX-License-Identifier: MIT
#include "core/estimation/ceres_solver.h"

#include <ceres/iteration_callback.h>
#include <ceres/problem.h>

#include <cmath>

#include "core/estimation/ceres_registration.h"
#include "manifolds/se3_manifold.h"

namespace trajlo {
namespace {

/// Ends the iterations by the rule of the Gauss-Newton solver: after as many steps as are wanted,
/// or after one that moved no pose by more than the tolerances. (Ceres's own tolerances end before
/// such a step is taken, and its own count includes steps that it rejects.)
class StopByGaussNewtonRule final : public ceres::IterationCallback {
 public:
  StopByGaussNewtonRule(const SolverOptions& options, const PoseBlocks* state)
      : options_(options), state_(state), before_(state->Poses()) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& iteration) override {
    if (iteration.iteration == 0) return ceres::SOLVER_CONTINUE;
    if (!iteration.step_is_successful) {
      if (!IsRoundOff(iteration)) {
        ++rejected_steps_;
        return ceres::SOLVER_CONTINUE;
      }
      ++steps_taken_;
      return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
    }
    ++steps_taken_;
    std::vector<SE3> now = state_->Poses();
    const StepSize step = MeasureStep(before_, now);
    before_ = std::move(now);
    return steps_taken_ >= options_.iterations_per_round || step.IsSmall(options_)
               ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
               : ceres::SOLVER_CONTINUE;
  }

  int steps_taken() const { return steps_taken_; }
  int rejected_steps() const { return rejected_steps_; }

 private:
  /// At the optimum a step changes the cost by its last bits, up or down.
  static bool IsRoundOff(const ceres::IterationSummary& iteration) {
    return std::abs(iteration.cost_change) < 1e-12 * iteration.cost;
  }

  const SolverOptions& options_;
  const PoseBlocks* state_;
  std::vector<SE3> before_;
  int steps_taken_ = 0;
  int rejected_steps_ = 0;
};

/// From no damping to a step that is short enough, Levenberg-Marquardt needs about so many tries.
constexpr int kMostRejectedSteps = 12;

ceres::Solver::Options MakeSolverOptions(const SolverOptions& options) {
  ceres::Solver::Options result;
  const CeresOptions& c = options.ceres;
  switch (c.linear_solver) {
    case LinearSolverKind::kDenseNormalCholesky:
      result.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
      break;
    case LinearSolverKind::kDenseQr:
      result.linear_solver_type = ceres::DENSE_QR;
      break;
    case LinearSolverKind::kSparseNormalCholesky:
      result.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
      result.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
      break;
    case LinearSolverKind::kCgnr:
      result.linear_solver_type = ceres::CGNR;
      break;
  }
  result.trust_region_strategy_type =
      c.trust_region == TrustRegionKind::kDogleg ? ceres::DOGLEG : ceres::LEVENBERG_MARQUARDT;
  result.initial_trust_region_radius = c.initial_trust_region_radius;
  result.max_trust_region_radius = std::max(1e16, c.initial_trust_region_radius);
  result.function_tolerance = c.function_tolerance;
  result.gradient_tolerance = c.gradient_tolerance;
  result.parameter_tolerance = c.parameter_tolerance;
  result.max_num_iterations = options.iterations_per_round + kMostRejectedSteps;
  result.update_state_every_iteration = true;
  // First-estimate Jacobians are not the derivative of the residual: a step that lowers the cost a
  // little less than they promise is still right.
  result.min_relative_decrease = 0.0;
  result.logging_type = ceres::SILENT;
  result.num_threads = 1;
  return result;
}

}  // namespace

CeresSolver::CeresSolver(const SolverOptions& options, ThreadPool* threads)
    : options_(options), solver_options_(MakeSolverOptions(options)), evaluator_(threads) {}

SolveSummary CeresSolver::Solve(WindowProblem* problem) {
  const bool is_prepared = options_.ceres.registration == RegistrationForm::kPrepared;
  PoseBlocks blocks(problem->poses);
  PrepareRegistration prepare(problem, options_, &blocks, &evaluator_, &registration_);
  SE3Manifold manifold;
  RobustKernelLoss loss(problem->noise.kernel);
  ceres::Problem::Options problem_options;
  problem_options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.disable_all_safety_checks = true;
  if (is_prepared) problem_options.evaluation_callback = &prepare;
  ceres::Problem ceres_problem(problem_options);
  for (std::size_t k = 0; k < problem->poses.size(); ++k) {
    ceres_problem.AddParameterBlock(blocks.block(static_cast<int>(k)), 7, &manifold);
  }
  AddRegistration(*problem, options_.ceres.registration, prepare, &loss, &blocks, &ceres_problem);
  for (int k = 0; k < problem->segments(); ++k) {
    ceres_problem.AddResidualBlock(
        new SmoothnessCost(problem->smoothness[k], problem->LinearizationPoint(k)), nullptr,
        blocks.block(k), blocks.block(k + 1));
  }
  ceres_problem.AddResidualBlock(
      new MarginalizationPriorCost(problem->prior, problem->first_estimate_jacobians), nullptr,
      blocks.block(0));

  StopByGaussNewtonRule stop(options_, &blocks);
  ceres::Solver::Options solver_options = solver_options_;
  solver_options.callbacks = {&stop};
  ceres::Solver::Summary ceres_summary;
  ceres::Solve(solver_options, &ceres_problem, &ceres_summary);

  SolveSummary summary;
  summary.iterations = stop.steps_taken();
  summary.rejected_steps = stop.rejected_steps();
  for (const ceres::IterationSummary& iteration : ceres_summary.iterations) {
    if (iteration.step_is_successful) summary.costs.push_back(iteration.cost);
  }
  summary.evaluate_s = ceres_summary.residual_evaluation_time_in_seconds +
                       ceres_summary.jacobian_evaluation_time_in_seconds;
  summary.linear_solve_s = ceres_summary.linear_solver_time_in_seconds;
  const std::vector<SE3> solution = blocks.Poses();
  for (const SE3& pose : solution) summary.finite = summary.finite && pose.IsFinite();
  summary.finite = summary.finite && ceres_summary.IsSolutionUsable();
  if (!summary.finite) return summary;
  summary.step = MeasureStep(problem->poses, solution);
  problem->poses = solution;
  // After a rejected step the last evaluation was elsewhere.
  if (is_prepared && prepare.is_linearized() &&
      ceres_summary.iterations.back().step_is_successful) {
    summary.registration = &registration_;
  }

  summary.cost = CostWithoutRegistration(*problem);
  summary.cost.registration = ceres_summary.final_cost - summary.cost.Total();
  return summary;
}

}  // namespace trajlo
