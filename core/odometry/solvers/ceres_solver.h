// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/solver.h>

#include <cstddef>
#include <functional>
#include <memory>

#include "core/odometry/solvers/window_solver.h"
#include "core/odometry/window/registration_evaluator.h"

namespace trajlo {

/// The window as a Ceres problem: control poses are parameter blocks on SE3Manifold; each segment
/// has one condensed registration block and at most one motion block, the first poses have the
/// prior. An evaluation callback computes the registration of all segments in parallel. The problem
/// lives on from solve to solve; its blocks read the present window.
///
/// Levenberg-Marquardt begins without damping, so that a step is one of Gauss-Newton unless it
/// raises the cost.
class CeresSolver final : public WindowSolver {
 public:
  /// What Ceres is given for a window with this number of poses.
  using CeresOptions = std::function<ceres::Solver::Options(std::size_t poses)>;

  CeresSolver(const SolverOptions& options, ThreadPool* threads);
  /// With other options of Ceres, for comparison.
  CeresSolver(const SolverOptions& options, CeresOptions ceres_options, ThreadPool* threads);
  ~CeresSolver() override;

  SolveSummary Solve(Window* window) override;

 private:
  class LivingProblem;
  SolverOptions options_;
  CeresOptions ceres_options_;
  RegistrationEvaluator evaluator_;
  std::unique_ptr<LivingProblem> problem_;
};

}  // namespace trajlo
