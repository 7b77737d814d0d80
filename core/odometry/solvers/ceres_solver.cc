// SPDX-License-Identifier: MIT
#include "core/odometry/solvers/ceres_solver.h"

#include <ceres/iteration_callback.h>
#include <ceres/problem.h>

#include <algorithm>
#include <cmath>

#include "core/odometry/solvers/ceres_registration.h"
#include "manifolds/se3_manifold.h"

namespace trajlo {
namespace {

/// Ends the iterations by the rule of the Gauss-Newton solver: after as many steps as are wanted,
/// or after one that moved no pose by more than the tolerances. (Ceres's own tolerances end before
/// such a step is taken, and its own count includes steps that it rejects.)
class StopByGaussNewtonRule final : public ceres::IterationCallback {
 public:
  StopByGaussNewtonRule(const SolverOptions& options, bool first_estimate_jacobians,
                        PoseBlocks* state, const PrepareRegistration* prepare)
      : options_(options),
        uphill_tolerance_(first_estimate_jacobians ? kFirstEstimateError : kRoundOff),
        state_(state),
        prepare_(prepare),
        before_(state->Poses()) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& iteration) override {
    if (iteration.iteration == 0) {
      if (costs_.empty()) costs_.push_back(iteration.cost);
      return ceres::SOLVER_CONTINUE;
    }
    last_was_taken_ = iteration.step_is_successful;
    if (last_was_taken_) return Take(state_->Poses(), iteration.cost);
    // Of a step that could not be computed, nothing was evaluated.
    if (!iteration.step_is_valid ||
        std::abs(iteration.cost_change) > uphill_tolerance_ * iteration.cost) {
      ++rejected_steps_;
      return ceres::SOLVER_CONTINUE;
    }
    taken_uphill_ = prepare_->evaluated_poses();
    Take(taken_uphill_, iteration.cost);
    return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

  /// After Ceres ended: puts the state to the step that Ceres rejected and this rule takes, if that
  /// was the end. Returns whether Ceres should go on from there.
  bool TakeUphillStep() {
    if (taken_uphill_.empty()) return false;
    state_->SetPoses(taken_uphill_);
    taken_uphill_.clear();
    last_was_taken_ = true;
    return !is_done_;
  }

  int steps_taken() const { return std::max(0, static_cast<int>(costs_.size()) - 1); }
  int rejected_steps() const { return rejected_steps_; }
  bool last_was_taken() const { return last_was_taken_; }
  /// At the start and after each step that was taken.
  const std::vector<double>& costs() const { return costs_; }

 private:
  /// At the optimum a step changes the cost by its last bits, up or down.
  static constexpr double kRoundOff = 1e-12;
  /// First-estimate Jacobians are not the derivative of the cost. Near the solution their step may
  /// raise it, however short it is made: by 3e-6 of it at most, as far as was seen.
  static constexpr double kFirstEstimateError = 1e-4;

  ceres::CallbackReturnType Take(const std::vector<SE3>& now, double cost) {
    costs_.push_back(cost);
    is_done_ = steps_taken() >= options_.iterations_per_round ||
               MeasureStep(before_, now).IsSmall(options_);
    before_ = now;
    return is_done_ ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

  const SolverOptions& options_;
  const double uphill_tolerance_;
  PoseBlocks* state_;
  const PrepareRegistration* prepare_;
  std::vector<SE3> before_, taken_uphill_;
  std::vector<double> costs_;
  int rejected_steps_ = 0;
  bool last_was_taken_ = false;
  bool is_done_ = false;
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
  PoseBlocks blocks(problem->poses);
  PrepareRegistration prepare(problem, options_, &blocks, &evaluator_, &registration_);
  SE3Manifold manifold;
  RobustKernelLoss loss(problem->noise.kernel);
  ceres::Problem::Options problem_options;
  problem_options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.disable_all_safety_checks = true;
  problem_options.evaluation_callback = &prepare;
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

  StopByGaussNewtonRule stop(options_, problem->first_estimate_jacobians, &blocks, &prepare);
  ceres::Solver::Options solver_options = solver_options_;
  solver_options.callbacks = {&stop};
  SolveSummary summary;
  ceres::Solver::Summary ceres_summary;
  do {
    ceres::Solve(solver_options, &ceres_problem, &ceres_summary);
    summary.evaluate_s += ceres_summary.residual_evaluation_time_in_seconds +
                          ceres_summary.jacobian_evaluation_time_in_seconds;
    summary.linear_solve_s += ceres_summary.linear_solver_time_in_seconds;
  } while (stop.TakeUphillStep());

  summary.iterations = stop.steps_taken();
  summary.rejected_steps = stop.rejected_steps();
  summary.costs = stop.costs();
  const std::vector<SE3> solution = blocks.Poses();
  for (const SE3& pose : solution) summary.finite = summary.finite && pose.IsFinite();
  summary.finite = summary.finite && ceres_summary.IsSolutionUsable();
  if (!summary.finite) return summary;
  summary.step = MeasureStep(problem->poses, solution);
  problem->poses = solution;
  // After a rejected step the last evaluation was elsewhere.
  if (prepare.is_linearized() && stop.last_was_taken()) summary.registration = &registration_;

  summary.cost = CostWithoutRegistration(*problem);
  summary.cost.registration = summary.costs.back() - summary.cost.Total();
  return summary;
}

}  // namespace trajlo
