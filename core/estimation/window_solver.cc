// SPDX-License-Identifier: MIT
#include "core/estimation/window_solver.h"

#include <algorithm>

#include "core/estimation/ceres_solver.h"
#include "core/estimation/gauss_newton_solver.h"

namespace trajlo {

std::unique_ptr<WindowSolver> MakeWindowSolver(const SolverOptions& options, ThreadPool* threads) {
  if (options.kind == SolverKind::kGaussNewton) {
    return std::make_unique<GaussNewtonSolver>(options, threads);
  }
  return std::make_unique<CeresSolver>(options, threads);
}

void MeasureStep(const std::vector<SE3>& start, const std::vector<SE3>& solution,
                 SolveSummary* summary) {
  summary->step_m = 0.0;
  summary->step_rad = 0.0;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const SE3 step = start[i].Inverse() * solution[i];
    summary->step_m = std::max(summary->step_m, step.t.norm());
    summary->step_rad = std::max(summary->step_rad, so3::Log(step.q).norm());
  }
}

}  // namespace trajlo
