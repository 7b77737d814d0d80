// SPDX-License-Identifier: MIT
#include "core/comparison/lockstep_solver.h"

#include <utility>

#include "core/comparison/forms/ceres_form_solver.h"
#include "core/timing/stopwatch.h"

namespace trajlo {
namespace {

WindowCost CostOf(Window window, RegistrationEvaluator* evaluator) {
  const std::vector<SE3> poses = window.Poses();
  std::vector<RegistrationNormalEquations> registration;
  evaluator->Evaluate(&window, poses, false, &registration);
  WindowCost cost = CostWithoutRegistration(window, poses);
  for (const auto& segment : registration) cost.registration += segment.cost;
  return cost;
}

/// Gauss-Newton leaves out the cost after its last step. `solved` has the weights that the variant
/// minimised with.
void AddLastCost(const Window& solved, RegistrationEvaluator* evaluator, SolveSummary* summary) {
  const bool is_missing = summary->costs.size() == static_cast<std::size_t>(summary->iterations);
  if (summary->finite && is_missing) summary->costs.push_back(CostOf(solved, evaluator).Total());
}

}  // namespace

LockstepSolver::LockstepSolver(const std::vector<SolverVariant>& variants,
                               const LockstepOptions& options,
                               std::unique_ptr<WindowSolver> leading, ThreadPool* threads,
                               OnRecord on_record)
    : variants_(variants),
      options_(options),
      leading_(std::move(leading)),
      evaluator_(threads),
      on_record_(std::move(on_record)) {
  for (const SolverVariant& variant : variants) {
    SolverOptions solver = variant.odometry.solver;
    solver.iterations_per_round = options.max_iterations;
    solver.step_tolerance = options.step_tolerance;
    solvers_.push_back(MakeSolverFactory(variant.ceres_form)(solver, threads));
  }
}

SolveSummary LockstepSolver::Solve(Window* window) {
  if (window_end_ns_ != window->EndNs()) {
    window_end_ns_ = window->EndNs();
    ++window_;
    if (window_ % options_.every == 0) Compare(*window);
  }
  return leading_->Solve(window);
}

void LockstepSolver::Compare(const Window& window) {
  std::vector<SE3> first_solution;
  LockstepRecord record;
  record.window = window_;
  for (const Segment& segment : window.segments) {
    record.points += static_cast<int>(segment.points.size());
  }
  record.cost_before = CostOf(window, &evaluator_);
  for (record.variant = 0; record.variant < variants_.size(); ++record.variant) {
    const OdometryOptions& odometry = variants_[record.variant].odometry;
    Window own = window;
    own.noise.kernel.kind = odometry.registration.kernel;
    for (Segment& segment : own.segments) segment.linearization.reset();
    own.prior.first_estimate_jacobians = odometry.marginalization.first_estimate_jacobians;
    Stopwatch watch;
    record.summary = solvers_[record.variant]->Solve(&own);
    record.total_s = watch.Seconds();
    AddLastCost(own, &evaluator_, &record.summary);
    const std::vector<SE3> solution = own.Poses();
    if (record.variant == 0) first_solution = solution;
    record.from_first = MeasureStep(first_solution, solution);
    own.noise = window.noise;
    record.cost_after = CostOf(own, &evaluator_);
    on_record_(record);
  }
}

WindowSolverFactory MakeLockstepFactory(const std::vector<SolverVariant>& variants,
                                        const LockstepOptions& options,
                                        WindowSolverFactory make_leading,
                                        LockstepSolver::OnRecord on_record) {
  const auto has_made_one = std::make_shared<bool>(false);
  return [=, &variants](const SolverOptions& solver, ThreadPool* threads) {
    std::unique_ptr<WindowSolver> leading = make_leading(solver, threads);
    if (std::exchange(*has_made_one, true)) return leading;
    leading =
        std::make_unique<LockstepSolver>(variants, options, std::move(leading), threads, on_record);
    return leading;
  };
}

}  // namespace trajlo
