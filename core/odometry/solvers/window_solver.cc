// SPDX-License-Identifier: MIT
#include "core/odometry/solvers/window_solver.h"

#include <algorithm>

#include "core/odometry/solvers/ceres_solver.h"
#include "core/odometry/solvers/gauss_newton_solver.h"

namespace trajlo {

std::unique_ptr<WindowSolver> MakeWindowSolver(const SolverOptions& options, ThreadPool* threads) {
  if (options.kind == SolverKind::kGaussNewton) {
    return std::make_unique<GaussNewtonSolver>(options, threads);
  }
  return std::make_unique<CeresSolver>(options, threads);
}

StepSize MeasureStep(const std::vector<SE3>& start, const std::vector<SE3>& end) {
  StepSize size;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const SE3 step = start[i].Inverse() * end[i];
    size.translation_m = std::max(size.translation_m, step.t.norm());
    size.rotation_rad = std::max(size.rotation_rad, so3::Log(step.q).norm());
  }
  return size;
}

}  // namespace trajlo
