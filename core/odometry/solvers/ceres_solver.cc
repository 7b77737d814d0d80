// SPDX-License-Identifier: MIT
#include "core/odometry/solvers/ceres_solver.h"

#include <ceres/problem.h>
#include <ceres/solver.h>

#include "core/odometry/solvers/ceres_steps.h"
#include "core/odometry/solvers/prepare_registration.h"
#include "factors/segment_registration.h"
#include "manifolds/se3_manifold.h"

namespace trajlo {
namespace {

/// What decides the blocks of the problem: another one needs another problem.
struct Structure {
  std::size_t segments = 0;
  std::vector<std::size_t> motion_kinds;
  int prior_poses = 0;

  explicit Structure(const Window& window)
      : segments(window.segments.size()), prior_poses(window.prior.poses()) {
    for (const Segment& segment : window.segments) motion_kinds.push_back(segment.motion.index());
  }
  bool operator==(const Structure& other) const {
    return segments == other.segments && motion_kinds == other.motion_kinds &&
           prior_poses == other.prior_poses;
  }
};

}  // namespace

/// The Ceres problem of one structure. Its blocks hold pointers to slots, which are filled anew for
/// each solve.
class CeresSolver::LivingProblem {
 public:
  LivingProblem(const Window& window, RegistrationEvaluator* evaluator)
      : structure_(window),
        blocks_(window.segments.size() + 1),
        prepare_(&blocks_, evaluator),
        known_(window.segments.size()),
        free_(window.segments.size()),
        prior_(window.prior),
        problem_(MakeProblemOptions(&prepare_)) {
    prepare_.Resize(window.segments.size());
    for (int k = 0; k <= window.size(); ++k) {
      problem_.AddParameterBlock(blocks_.block(k), 7, &manifold_);
    }
    for (int k = 0; k < window.size(); ++k) {
      problem_.AddResidualBlock(new PreparedRegistrationCost(prepare_.equations(k)), nullptr,
                                blocks_.block(k), blocks_.block(k + 1));
      AddMotion(window.segments[static_cast<std::size_t>(k)].motion, k);
    }
    std::vector<double*> poses;
    for (int k = 0; k < prior_.poses(); ++k) poses.push_back(blocks_.block(k));
    problem_.AddResidualBlock(new MarginalizationPriorCost(&prior_), nullptr, poses);
  }

  bool Fits(const Window& window) const { return structure_ == Structure(window); }

  SolveSummary Solve(const SolverOptions& options, Window* window) {
    const std::vector<SE3> start = window->Poses();
    blocks_.SetPoses(start);
    prepare_.Begin(window, options.iterations_per_round);
    FillSlots(*window);
    StopAfterSteps stop(options, &blocks_);
    ceres::Solver::Options solver_options = UndampedSolverOptions(options.iterations_per_round);
    solver_options.callbacks = {&stop};
    ceres::Solver::Summary ceres_summary;
    ceres::Solve(solver_options, &problem_, &ceres_summary);

    SolveSummary summary = Summarize(stop, ceres_summary);
    const std::vector<SE3> solution = blocks_.Poses();
    AcceptSolution(start, solution, ceres_summary, window, &summary);
    if (!summary.finite) return summary;
    const auto& registration = prepare_.At(solution);
    for (std::size_t k = 0; k < registration.size(); ++k) {
      window->segments[k].registration = registration[k];
    }
    return summary;
  }

 private:
  static ceres::Problem::Options MakeProblemOptions(PrepareRegistration* prepare) {
    ceres::Problem::Options options;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.disable_all_safety_checks = true;
    options.evaluation_callback = prepare;
    return options;
  }

  void AddMotion(const MotionTerm& motion, int k) {
    const auto slot = static_cast<std::size_t>(k);
    if (std::holds_alternative<SmoothnessTerm>(motion)) {
      problem_.AddResidualBlock(new SmoothnessCost(&known_[slot]), nullptr, blocks_.block(k),
                                blocks_.block(k + 1));
    } else if (std::holds_alternative<WhiteNoiseAccelerationTerm>(motion)) {
      problem_.AddResidualBlock(new WhiteNoiseAccelerationCost(&free_[slot]), nullptr,
                                blocks_.block(k - 1), blocks_.block(k), blocks_.block(k + 1));
    }
  }

  void FillSlots(const Window& window) {
    for (std::size_t k = 0; k < window.segments.size(); ++k) {
      const MotionTerm& motion = window.segments[k].motion;
      if (const auto* known = std::get_if<SmoothnessTerm>(&motion)) known_[k] = *known;
      if (const auto* free = std::get_if<WhiteNoiseAccelerationTerm>(&motion)) free_[k] = *free;
    }
    prior_ = window.prior;
  }

  Structure structure_;
  PoseBlocks blocks_;
  PrepareRegistration prepare_;
  std::vector<SmoothnessTerm> known_;  ///< The slots, one a segment.
  std::vector<WhiteNoiseAccelerationTerm> free_;
  MarginalizationPrior prior_;
  SE3Manifold manifold_;
  ceres::Problem problem_;
};

CeresSolver::CeresSolver(const SolverOptions& options, ThreadPool* threads)
    : options_(options), evaluator_(threads, options.step_tolerance) {}
CeresSolver::~CeresSolver() = default;

SolveSummary CeresSolver::Solve(Window* window) {
  if (!problem_ || !problem_->Fits(*window)) {
    problem_ = std::make_unique<LivingProblem>(*window, &evaluator_);
  }
  return problem_->Solve(options_, window);
}

}  // namespace trajlo
