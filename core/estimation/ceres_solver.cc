// SPDX-License-Identifier: MIT
#include "core/estimation/ceres_solver.h"

#include <ceres/evaluation_callback.h>
#include <ceres/iteration_callback.h>
#include <ceres/problem.h>

#include <cmath>

#include "manifolds/se3_manifold.h"

namespace trajlo {
namespace {

/// Computes the registration of all segments before Ceres asks the blocks for it.
class PrepareRegistration final : public ceres::EvaluationCallback {
 public:
  PrepareRegistration(const WindowProblem* problem, const SolverOptions& options,
                      RegistrationEvaluator* evaluator,
                      std::vector<RegistrationNormalEquations>* equations)
      : problem_(problem),
        options_(options),
        evaluator_(evaluator),
        equations_(equations),
        blocks_(problem->poses.size()) {
    equations_->resize(problem->points.size());
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      std::copy_n(problem->poses[i].data(), 7, blocks_[i].data());
    }
  }

  /// Ceres asks for the cost of a step first and, as nearly every step is accepted, for the
  /// Jacobians at the same point next: they are computed together. Jacobians at the point where the
  /// solve ends serve marginalisation; only where each step is followed by new associations, unless
  /// it is so small that it is the last one, nobody wants them, and the cost is enough.
  void PrepareForEvaluation(bool, bool new_evaluation_point) override {
    if (!new_evaluation_point) return;
    const std::vector<SE3> poses = Poses();
    is_linearized_ = points_++ == 0 || options_.iterations_per_round > 1 ||
                     MeasureStep(problem_->poses, poses).IsSmall(options_);
    evaluator_->Evaluate(*problem_, poses, is_linearized_, equations_);
  }

  std::vector<SE3> Poses() const {
    std::vector<SE3> poses;
    for (const auto& block : blocks_) poses.push_back(SE3::FromData(block.data()));
    return poses;
  }

  /// Whether the equations hold more than the cost.
  bool is_linearized() const { return is_linearized_; }
  double* block(int k) { return blocks_[static_cast<std::size_t>(k)].data(); }
  const RegistrationNormalEquations* equations(int k) const { return &(*equations_)[k]; }

 private:
  const WindowProblem* problem_;
  const SolverOptions& options_;
  RegistrationEvaluator* evaluator_;
  std::vector<RegistrationNormalEquations>* equations_;
  int points_ = 0;
  bool is_linearized_ = false;
  std::vector<std::array<double, 7>> blocks_;
};

/// Ends the iterations by the rule of the Gauss-Newton solver: after as many steps as are wanted,
/// or after one that moved no pose by more than the tolerances. (Ceres's own tolerances end before
/// such a step is taken, and its own count includes steps that it rejects.)
class StopByGaussNewtonRule final : public ceres::IterationCallback {
 public:
  StopByGaussNewtonRule(const SolverOptions& options, const PrepareRegistration* state)
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
  const PrepareRegistration* state_;
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
  PrepareRegistration prepare(problem, options_, &evaluator_, &registration_);
  SE3Manifold manifold;
  ceres::Problem::Options problem_options;
  problem_options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.disable_all_safety_checks = true;
  problem_options.evaluation_callback = &prepare;
  ceres::Problem ceres_problem(problem_options);
  for (std::size_t k = 0; k < problem->poses.size(); ++k) {
    ceres_problem.AddParameterBlock(prepare.block(static_cast<int>(k)), 7, &manifold);
  }
  for (int k = 0; k < problem->segments(); ++k) {
    double* begin = prepare.block(k);
    double* end = prepare.block(k + 1);
    if (!problem->points[k]->empty()) {
      ceres_problem.AddResidualBlock(new PreparedRegistrationCost(prepare.equations(k)), nullptr,
                                     begin, end);
    }
    ceres_problem.AddResidualBlock(
        new SmoothnessCost(problem->smoothness[k], problem->LinearizationPoint(k)), nullptr, begin,
        end);
  }
  ceres_problem.AddResidualBlock(
      new MarginalizationPriorCost(problem->prior, problem->first_estimate_jacobians), nullptr,
      prepare.block(0));

  StopByGaussNewtonRule stop(options_, &prepare);
  ceres::Solver::Options solver_options = solver_options_;
  solver_options.callbacks = {&stop};
  ceres::Solver::Summary ceres_summary;
  ceres::Solve(solver_options, &ceres_problem, &ceres_summary);

  SolveSummary summary;
  summary.iterations = stop.steps_taken();
  summary.rejected_steps = stop.rejected_steps();
  const std::vector<SE3> solution = prepare.Poses();
  for (const SE3& pose : solution) summary.finite = summary.finite && pose.IsFinite();
  summary.finite = summary.finite && ceres_summary.IsSolutionUsable();
  if (!summary.finite) return summary;
  summary.step = MeasureStep(problem->poses, solution);
  problem->poses = solution;
  // After a rejected step the last evaluation was elsewhere.
  if (prepare.is_linearized() && ceres_summary.iterations.back().step_is_successful) {
    summary.registration = &registration_;
  }

  summary.cost.prior = 0.5 * problem->prior.Residual(solution[0]).squaredNorm();
  for (int k = 0; k < problem->segments(); ++k) {
    summary.cost.smoothness +=
        0.5 * problem->smoothness[k].Residual(solution[k], solution[k + 1]).squaredNorm();
  }
  summary.cost.registration =
      ceres_summary.final_cost - summary.cost.smoothness - summary.cost.prior;
  return summary;
}

}  // namespace trajlo
