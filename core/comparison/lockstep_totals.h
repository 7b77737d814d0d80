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
  double TotalMs() const { return PerWindow(1e3 * total_s_); }
  double EvaluateMs() const { return PerWindow(1e3 * evaluate_s_); }
  double LinearSolveMs() const { return PerWindow(1e3 * linear_solve_s_); }
  /// Of the window's own cost, mean over the windows.
  double CostAfter() const { return PerWindow(cost_after_); }
  /// Distances of the solutions from those of the first variant.
  double MedianDistance_m() const;
  double MaxDistance_m() const;
  double MaxDistance_rad() const;

 private:
  double PerWindow(double sum) const { return windows_ > 0 ? sum / windows_ : 0.0; }

  int windows_ = 0, not_finite_ = 0, rejected_steps_ = 0, steps_ = 0;
  double total_s_ = 0.0, evaluate_s_ = 0.0, linear_solve_s_ = 0.0, cost_after_ = 0.0;
  std::vector<double> distances_m_, distances_rad_;
};

}  // namespace trajlo
