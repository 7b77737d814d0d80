// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/comparison/lockstep_solver.h"

namespace trajlo {

/// What one variant did over all compared windows.
class LockstepTotals {
 public:
  void Add(const LockstepRecord& record);

  int windows() const { return windows_; }
  int not_finite() const { return not_finite_; }
  int rejected_steps() const { return rejected_steps_; }
  double StepsPerWindow() const { return PerWindow(steps_); }
  /// Medians over the windows: one in which the computer was busy does not decide.
  double MedianTotalMs() const;
  double MedianEvaluateMs() const;
  double MedianLinearSolveMs() const;
  /// Of the window's own cost, mean over the windows.
  double CostAfter() const { return PerWindow(cost_after_); }
  /// Distances of the solutions from those of the first variant.
  double MedianDistance_m() const;
  double MaxDistance_m() const;
  double MaxDistance_rad() const;

 private:
  double PerWindow(double sum) const { return windows_ > 0 ? sum / windows_ : 0.0; }

  int windows_ = 0, not_finite_ = 0, rejected_steps_ = 0, steps_ = 0;
  double cost_after_ = 0.0;
  std::vector<double> total_s_, evaluate_s_, linear_solve_s_, distances_m_, distances_rad_;
};

}  // namespace trajlo
