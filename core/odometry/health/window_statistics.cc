// SPDX-License-Identifier: MIT
#include "core/odometry/health/window_statistics.h"

#include <algorithm>
#include <cmath>

namespace trajlo {
namespace {

constexpr double kShortSegment_s = 0.03;

}  // namespace

StepSize RestlessStep(const SegmentCloud& newest) {
  const double seen_s = newest.is_instant ? 0.0 : newest.Duration_s();
  const double longer = std::max(1.0, seen_s / kShortSegment_s);
  const double factor = longer * std::sqrt(longer);
  return {kRestlessStep.translation_m * factor, kRestlessStep.rotation_rad * factor};
}

void WindowStatistics::Add(const SolveSummary& solve, const SolverOptions& options) {
  ++rounds;
  iterations += solve.iterations;
  rejected_steps += solve.rejected_steps;
  cost = solve.cost;
  // Steps shrink by a constant factor at least, which the last two of them show.
  StepSize next = solve.step;
  if (rounds > 1) {
    next.translation_m *= std::min(1.0, solve.step.translation_m / last_step.translation_m);
    next.rotation_rad *= std::min(1.0, solve.step.rotation_rad / last_step.rotation_rad);
  }
  if (!next.IsWithin(restless)) restless_rounds = rounds;
  last_step = solve.step;
  is_finite = solve.finite;
  // Where every step was rejected, the window is as unsolved as before.
  has_converged =
      next.IsWithin(options.step_tolerance) && (solve.iterations > 0 || solve.rejected_steps == 0);
}

void Describe(const Window& window, WindowStatistics* statistics) {
  statistics->begin_ns = window.begin_ns;
  statistics->end_ns = window.segments.back().cloud.end_ns;
  statistics->segments = window.size();
  statistics->points = 0;
  statistics->inliers = 0;
  for (const Segment& segment : window.segments) {
    statistics->points += static_cast<int>(segment.cloud.registration_points.size());
    statistics->inliers += static_cast<int>(segment.points.size());
  }
}

}  // namespace trajlo
