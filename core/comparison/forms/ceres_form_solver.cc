// SPDX-License-Identifier: MIT
#include "core/comparison/forms/ceres_form_solver.h"

#include <ceres/autodiff_cost_function.h>
#include <ceres/solver.h>

#include <array>
#include <cstddef>

#include "core/comparison/forms/point_to_plane_autodiff.h"
#include "core/comparison/forms/segment_residuals.h"
#include "core/odometry/solvers/ceres_blocks.h"
#include "core/odometry/solvers/ceres_solver.h"
#include "core/odometry/solvers/ceres_steps.h"
#include "core/odometry/solvers/prepare_registration.h"
#include "factors/point_to_plane.h"
#include "factors/segment_registration.h"

namespace trajlo {
namespace {

void SetLinearSolver(LinearSolverKind kind, ceres::Solver::Options* options) {
  switch (kind) {
    case LinearSolverKind::kByLength:
      return;  // As it is.
    case LinearSolverKind::kDenseNormalCholesky:
      options->linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
      return;
    case LinearSolverKind::kDenseQr:
      options->linear_solver_type = ceres::DENSE_QR;
      return;
    case LinearSolverKind::kSparseNormalCholesky:
      options->linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
      return;
    case LinearSolverKind::kCgnr:
      options->linear_solver_type = ceres::CGNR;
      return;
  }
}

ceres::Solver::Options MakeSolverOptions(const CeresFormOptions& form, int steps,
                                         std::size_t poses) {
  ceres::Solver::Options options = UndampedSolverOptions(steps, poses);
  SetLinearSolver(form.linear_solver, &options);
  options.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  options.trust_region_strategy_type =
      form.trust_region == TrustRegionKind::kDogleg ? ceres::DOGLEG : ceres::LEVENBERG_MARQUARDT;
  options.initial_trust_region_radius = form.initial_trust_region_radius;
  return options;
}

/// Of the points of a segment, by their axes.
using SegmentLosses = std::array<RobustKernelLoss, 3>;

SegmentLosses LossesOf(const RegistrationNoise& noise) {
  return {RobustKernelLoss(noise.KernelOf(0)), RobustKernelLoss(noise.KernelOf(1)),
          RobustKernelLoss(noise.KernelOf(2))};
}

/// The registration of segment k in another form.
void AddRegistration(const CeresFormOptions& form, const Window& window, int k,
                     SegmentLosses* losses, CeresBlocks* blocks) {
  const std::vector<RegistrationPoint>& points = window.At(k).points;
  if (points.empty()) return;
  const RegistrationNoise noise = window.NoiseOf(window.At(k));
  const double sigma_m = noise.sigma_m;
  const auto loss_of = [&](const RegistrationPoint& point) { return &(*losses)[point.axis]; };
  switch (form.registration) {
    case RegistrationForm::kPrepared:  // The same, but for CeresSolver's way to compute it.
    case RegistrationForm::kCondensed:
      blocks->AddRegistration(new SegmentRegistrationCost(&points, noise), nullptr, k);
      break;
    case RegistrationForm::kSegmentResiduals:
      blocks->AddRegistration(new SegmentResidualsCost(&points, noise), nullptr, k);
      break;
    case RegistrationForm::kPoint:
      for (const RegistrationPoint& point : points) {
        blocks->AddRegistration(new PointToPlaneCost(point, sigma_m), loss_of(point), k);
      }
      break;
    case RegistrationForm::kPointAutodiff:
      for (const RegistrationPoint& point : points) {
        blocks->AddRegistration(new ceres::AutoDiffCostFunction<PointToPlaneFunctor, 1, 7, 7>(
                                    new PointToPlaneFunctor{point, sigma_m}),
                                loss_of(point), k);
      }
      break;
  }
}

}  // namespace

SolveSummary CeresFormSolver::Solve(Window* window) {
  std::vector<SE3> poses = window->Poses();
  // The blocks do not use it. What it leaves is linearised where CeresSolver's is: at the start of
  // a single step, else at the end.
  PrepareRegistration prepare(&poses, &evaluator_);
  prepare.Begin(window, options_.iterations_per_round);
  if (options_.iterations_per_round == 1) prepare.PrepareForEvaluation(true, true);
  std::vector<SegmentLosses> losses;
  for (const Segment& segment : window->segments) {
    losses.push_back(LossesOf(window->NoiseOf(segment)));
  }
  CeresBlocks blocks(&poses, nullptr);
  for (int k = 0; k < window->size(); ++k) {
    AddRegistration(form_, *window, k, &losses[static_cast<std::size_t>(k)], &blocks);
    blocks.AddMotion(window->At(k).motion, k);
  }
  blocks.AddPrior(window->prior);
  const SolveSummary summary =
      SolveByCeres(options_, MakeSolverOptions(form_, options_.iterations_per_round, poses.size()),
                   &poses, blocks.problem(), window);
  if (summary.finite) prepare.Finish();
  return summary;
}

WindowSolverFactory MakeSolverFactory(const CeresFormOptions& form) {
  return
      [form](const SolverOptions& options, ThreadPool* threads) -> std::unique_ptr<WindowSolver> {
        if (options.kind == SolverKind::kGaussNewton) return MakeWindowSolver(options, threads);
        if (form.registration == RegistrationForm::kPrepared) {
          return std::make_unique<CeresSolver>(
              options,
              [form, steps = options.iterations_per_round](std::size_t poses) {
                return MakeSolverOptions(form, steps, poses);
              },
              threads);
        }
        return std::make_unique<CeresFormSolver>(form, options, threads);
      };
}

}  // namespace trajlo
