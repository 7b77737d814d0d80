// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/comparison/solver_variant.h"
#include "core/odometry/solvers/window_solver.h"
#include "core/odometry/window/registration_evaluator.h"

namespace trajlo {

/// What one variant made of one window.
struct LockstepRecord {
  int window = 0;
  std::size_t variant = 0;  ///< Index into the list of variants.
  int points = 0;
  /// In the window's own weights and kernel, whatever the variant's are.
  WindowCost cost_before, cost_after;
  /// Distance of the solution from that of the first variant, the largest over the control poses.
  StepSize from_first;
  double total_s = 0.0;
  SolveSummary summary;  ///< Its costs have that of the last step, whatever the solver.
};

struct LockstepOptions {
  /// Each window is solved until the steps are this small, so that solutions can be compared.
  int max_iterations = 30;
  StepSize step_tolerance = {1e-9, 1e-10};
  /// One window out of this many is compared.
  int every = 1;
};

/// Solves windows like the solver that it stands for, and lets all variants solve the same windows
/// on the side: from the same poses, with the same associations and the same prior (those of the
/// window's first round). A window is another one where it ends at another time: some are taken
/// back and never reported.
class LockstepSolver final : public WindowSolver {
 public:
  using OnRecord = std::function<void(const LockstepRecord&)>;

  /// `variants` must outlive it.
  LockstepSolver(const std::vector<SolverVariant>& variants, const LockstepOptions& options,
                 std::unique_ptr<WindowSolver> leading, ThreadPool* threads, OnRecord on_record);

  SolveSummary Solve(Window* window) override;

 private:
  void Compare(const Window& window);

  const std::vector<SolverVariant>& variants_;
  LockstepOptions options_;
  std::unique_ptr<WindowSolver> leading_;
  std::vector<std::unique_ptr<WindowSolver>> solvers_;
  RegistrationEvaluator evaluator_;
  OnRecord on_record_;
  int window_ = -1;
  std::optional<std::int64_t> window_end_ns_;
};

/// The first solver that it makes, that of a run, is a LockstepSolver around what `make_leading`
/// makes. Those that follow try the motions with which the run may begin: they solve nothing on the
/// side. `variants` must outlive the solvers.
WindowSolverFactory MakeLockstepFactory(const std::vector<SolverVariant>& variants,
                                        const LockstepOptions& options,
                                        WindowSolverFactory make_leading,
                                        LockstepSolver::OnRecord on_record);

}  // namespace trajlo
