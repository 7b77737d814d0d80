// SPDX-License-Identifier: MIT
#include "core/comparison/lockstep_totals.h"

#include <algorithm>

#include "core/report/processing_time.h"

namespace trajlo {
namespace {

double Largest(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
}

}  // namespace

void LockstepTotals::Add(const LockstepRecord& record) {
  ++windows_;
  not_finite_ += record.summary.finite ? 0 : 1;
  rejected_steps_ += record.summary.rejected_steps;
  steps_ += record.summary.iterations;
  total_s_.push_back(record.total_s);
  evaluate_s_.push_back(record.summary.evaluate_s);
  linear_solve_s_.push_back(record.summary.linear_solve_s);
  cost_after_ += record.cost_after.Total();
  distances_m_.push_back(record.from_first.translation_m);
  distances_rad_.push_back(record.from_first.rotation_rad);
}

double LockstepTotals::MedianTotalMs() const { return 1e3 * Quantile(total_s_, 0.5); }
double LockstepTotals::MedianEvaluateMs() const { return 1e3 * Quantile(evaluate_s_, 0.5); }
double LockstepTotals::MedianLinearSolveMs() const { return 1e3 * Quantile(linear_solve_s_, 0.5); }
double LockstepTotals::MedianDistance_m() const { return Quantile(distances_m_, 0.5); }
double LockstepTotals::MaxDistance_m() const { return Largest(distances_m_); }
double LockstepTotals::MaxDistance_rad() const { return Largest(distances_rad_); }

}  // namespace trajlo
