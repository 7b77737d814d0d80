// SPDX-License-Identifier: MIT
#include "core/odometry/health/belief.h"

#include "core/odometry/health/condition.h"

namespace trajlo {

bool IsBelievable(const WindowStatistics& statistics, const LostOptions& options) {
  return statistics.is_finite && statistics.correction_m <= options.max_correction_m &&
         statistics.correction_rad <= options.max_correction_rad;
}

void Revert(const std::vector<SE3>& poses, Window* window) {
  window->SetPoses(poses);
  for (Segment& segment : window->segments) segment.registration = {};
}

void Judge(const Window& window, const LostOptions& options, WindowStatistics* statistics) {
  if (!window.is_believed) {
    statistics->flags |= kFlagReverted;
  } else if (!statistics->has_converged) {
    statistics->flags |= kFlagNotConverged;
  }
  if (window.segments.back().points.empty()) statistics->flags |= kFlagNoPoints;
  const WindowCondition condition = ConditionOf(window);
  statistics->smallest_eigenvalue = condition.smallest_eigenvalue;
  statistics->weak_direction = condition.weak_direction;
  if (condition.smallest_eigenvalue < options.degenerate_eigenvalue) {
    statistics->flags |= kFlagDegenerate;
  }
}

}  // namespace trajlo
