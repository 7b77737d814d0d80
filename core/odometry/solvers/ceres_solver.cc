// SPDX-License-Identifier: MIT
#include "core/odometry/solvers/ceres_solver.h"

#include <algorithm>
#include <utility>

#include "core/odometry/solvers/ceres_blocks.h"
#include "core/odometry/solvers/ceres_steps.h"
#include "core/odometry/solvers/prepare_registration.h"
#include "factors/segment_registration.h"

namespace trajlo {

/// The Ceres problem of windows with the same blocks. These point at its own terms, which are
/// those of another window for each solve.
class CeresSolver::LivingProblem {
 public:
  LivingProblem(const Window& window, RegistrationEvaluator* evaluator)
      : poses_(window.Poses()),
        prepare_(&poses_, evaluator),
        motion_(window.segments.size()),
        blocks_(&poses_, &prepare_) {
    TakeTerms(window);
    for (int k = 0; k < window.size(); ++k) {
      blocks_.AddRegistration(new PreparedRegistrationCost(prepare_.equations(k)), nullptr, k);
      blocks_.AddMotion(motion_[static_cast<std::size_t>(k)], k);
    }
    blocks_.AddPrior(prior_);
  }

  bool Fits(const Window& window) const {
    return prior_.poses() == window.prior.poses() &&
           std::equal(motion_.begin(), motion_.end(), window.segments.begin(),
                      window.segments.end(), [](const MotionTerm& own, const Segment& segment) {
                        return own.index() == segment.motion.index();
                      });
  }

  SolveSummary Solve(const SolverOptions& options, const ceres::Solver::Options& ceres_options,
                     Window* window) {
    TakeTerms(*window);
    prepare_.Begin(window, options.iterations_per_round);
    const SolveSummary summary =
        SolveByCeres(options, ceres_options, &poses_, blocks_.problem(), window);
    if (summary.finite) prepare_.Finish();
    return summary;
  }

 private:
  /// A term of the same kind stays where it was.
  void TakeTerms(const Window& window) {
    for (std::size_t k = 0; k < motion_.size(); ++k) motion_[k] = window.segments[k].motion;
    prior_ = window.prior;
  }

  std::vector<SE3> poses_;
  PrepareRegistration prepare_;
  std::vector<MotionTerm> motion_;
  MarginalizationPrior prior_;
  CeresBlocks blocks_;
};

CeresSolver::CeresSolver(const SolverOptions& options, ThreadPool* threads)
    : CeresSolver(
          options,
          [steps = options.iterations_per_round](std::size_t poses) {
            return UndampedSolverOptions(steps, poses);
          },
          threads) {}
CeresSolver::CeresSolver(const SolverOptions& options, CeresOptions ceres_options,
                         ThreadPool* threads)
    : options_(options),
      ceres_options_(std::move(ceres_options)),
      evaluator_(threads, options.step_tolerance) {}
CeresSolver::~CeresSolver() = default;

SolveSummary CeresSolver::Solve(Window* window) {
  if (!problem_ || !problem_->Fits(*window)) {
    problem_ = std::make_unique<LivingProblem>(*window, &evaluator_);
  }
  return problem_->Solve(options_, ceres_options_(window->segments.size() + 1), window);
}

}  // namespace trajlo
