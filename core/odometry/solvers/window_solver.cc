// SPDX-License-Identifier: MIT
#include "core/odometry/solvers/window_solver.h"

#include "core/odometry/solvers/ceres_solver.h"
#include "core/odometry/solvers/gauss_newton_solver.h"

namespace trajlo {

std::unique_ptr<WindowSolver> MakeWindowSolver(const SolverOptions& options, ThreadPool* threads) {
  if (options.kind == SolverKind::kGaussNewton) {
    return std::make_unique<GaussNewtonSolver>(options, threads);
  }
  return std::make_unique<CeresSolver>(options, threads);
}

}  // namespace trajlo
