// SPDX-License-Identifier: MIT
#include "core/comparison/forms/ceres_form_solver.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>

#include "core/comparison/forms/point_to_plane_autodiff.h"
#include "core/comparison/forms/segment_residuals.h"
#include "core/odometry/solvers/ceres_steps.h"
#include "core/odometry/solvers/prepare_registration.h"
#include "factors/point_to_plane.h"
#include "factors/segment_registration.h"
#include "manifolds/se3_manifold.h"

namespace trajlo {
namespace {

ceres::LinearSolverType LinearSolverOf(LinearSolverKind kind) {
  switch (kind) {
    case LinearSolverKind::kDenseNormalCholesky:
      return ceres::DENSE_NORMAL_CHOLESKY;
    case LinearSolverKind::kDenseQr:
      return ceres::DENSE_QR;
    case LinearSolverKind::kSparseNormalCholesky:
      return ceres::SPARSE_NORMAL_CHOLESKY;
    case LinearSolverKind::kCgnr:
      return ceres::CGNR;
  }
  return ceres::DENSE_NORMAL_CHOLESKY;
}

ceres::Solver::Options MakeSolverOptions(const CeresFormOptions& form, int steps) {
  ceres::Solver::Options options = UndampedSolverOptions(steps);
  options.linear_solver_type = LinearSolverOf(form.linear_solver);
  options.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  options.trust_region_strategy_type =
      form.trust_region == TrustRegionKind::kDogleg ? ceres::DOGLEG : ceres::LEVENBERG_MARQUARDT;
  options.initial_trust_region_radius = form.initial_trust_region_radius;
  return options;
}

/// One solve: the blocks of one window.
struct FormProblem {
  FormProblem(Window& of, const CeresFormOptions& form, int steps, RegistrationEvaluator* evaluator)
      : window(of),
        blocks(of.segments.size() + 1),
        prepare(&blocks, evaluator),
        loss(of.noise.kernel),
        problem(MakeOptions(form)) {
    blocks.SetPoses(window.Poses());
    prepare.Resize(window.segments.size());
    prepare.Begin(&window, steps);
    for (int k = 0; k <= window.size(); ++k) {
      problem.AddParameterBlock(blocks.block(k), 7, &manifold);
    }
    for (int k = 0; k < window.size(); ++k) {
      AddRegistration(form.registration, k);
      AddMotion(k);
    }
    std::vector<double*> poses;
    for (int k = 0; k < window.prior.poses(); ++k) poses.push_back(blocks.block(k));
    problem.AddResidualBlock(new MarginalizationPriorCost(&window.prior), nullptr, poses);
  }

  ceres::Problem::Options MakeOptions(const CeresFormOptions& form) {
    ceres::Problem::Options options;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.disable_all_safety_checks = true;
    if (form.registration == RegistrationForm::kPrepared) options.evaluation_callback = &prepare;
    return options;
  }

  void AddRegistration(RegistrationForm form, int k) {
    const std::vector<RegistrationPoint>& points =
        window.segments[static_cast<std::size_t>(k)].points;
    if (points.empty()) return;
    const auto add = [&](ceres::CostFunction* factor, ceres::LossFunction* kernel) {
      problem.AddResidualBlock(factor, kernel, blocks.block(k), blocks.block(k + 1));
    };
    const double sigma_m = window.noise.sigma_m;
    switch (form) {
      case RegistrationForm::kPrepared:
        add(new PreparedRegistrationCost(prepare.equations(k)), nullptr);
        break;
      case RegistrationForm::kCondensed:
        add(new SegmentRegistrationCost(&points, window.noise), nullptr);
        break;
      case RegistrationForm::kSegmentResiduals:
        add(new SegmentResidualsCost(&points, window.noise), nullptr);
        break;
      case RegistrationForm::kPoint:
        for (const RegistrationPoint& point : points) {
          add(new PointToPlaneCost(point, sigma_m), &loss);
        }
        break;
      case RegistrationForm::kPointAutodiff:
        for (const RegistrationPoint& point : points) {
          add(new ceres::AutoDiffCostFunction<PointToPlaneFunctor, 1, 7, 7>(
                  new PointToPlaneFunctor{point, sigma_m}),
              &loss);
        }
        break;
    }
  }

  void AddMotion(int k) {
    const MotionTerm& motion = window.segments[static_cast<std::size_t>(k)].motion;
    if (const auto* known = std::get_if<SmoothnessTerm>(&motion)) {
      problem.AddResidualBlock(new SmoothnessCost(known), nullptr, blocks.block(k),
                               blocks.block(k + 1));
    } else if (const auto* free = std::get_if<WhiteNoiseAccelerationTerm>(&motion)) {
      problem.AddResidualBlock(new WhiteNoiseAccelerationCost(free), nullptr, blocks.block(k - 1),
                               blocks.block(k), blocks.block(k + 1));
    }
  }

  Window& window;
  PoseBlocks blocks;
  PrepareRegistration prepare;
  SE3Manifold manifold;
  RobustKernelLoss loss;
  ceres::Problem problem;
};

}  // namespace

SolveSummary CeresFormSolver::Solve(Window* window) {
  const std::vector<SE3> start = window->Poses();
  FormProblem form(*window, form_, options_.iterations_per_round, &evaluator_);
  StopAfterSteps stop(options_, &form.blocks);
  ceres::Solver::Options options = MakeSolverOptions(form_, options_.iterations_per_round);
  options.callbacks = {&stop};
  ceres::Solver::Summary ceres_summary;
  ceres::Solve(options, &form.problem, &ceres_summary);

  SolveSummary summary = Summarize(stop, ceres_summary);
  const std::vector<SE3> solution = form.blocks.Poses();
  AcceptSolution(start, solution, ceres_summary, window, &summary);
  if (!summary.finite) return summary;
  std::vector<RegistrationNormalEquations> registration;
  evaluator_.Evaluate(window, solution, true, &registration);
  for (std::size_t k = 0; k < registration.size(); ++k) {
    window->segments[k].registration = registration[k];
  }
  return summary;
}

WindowSolverFactory MakeSolverFactory(const CeresFormOptions& form) {
  return
      [form](const SolverOptions& options, ThreadPool* threads) -> std::unique_ptr<WindowSolver> {
        if (options.kind == SolverKind::kGaussNewton || form.IsDefault()) {
          return MakeWindowSolver(options, threads);
        }
        return std::make_unique<CeresFormSolver>(form, options, threads);
      };
}

}  // namespace trajlo
