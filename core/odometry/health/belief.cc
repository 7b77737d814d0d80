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

void Judge(const LostOptions& options, double points_per_error, Window* window,
           WindowStatistics* statistics) {
  Segment& newest = window->segments.back();
  newest.feigned =
      FeignedBy(newest.points, window->Pose(window->size() - 1), newest.T_world_end, window->noise);
  if (!window->is_believed) {
    statistics->flags |= kFlagReverted;
  } else if (!statistics->has_converged) {
    statistics->flags |= kFlagNotConverged;
  }
  if (newest.points.empty()) statistics->flags |= kFlagNoPoints;
  const WindowCondition condition = ConditionOf(*window, points_per_error);
  statistics->smallest_eigenvalue = condition.smallest_eigenvalue;
  statistics->weak_direction = condition.weak_direction;
  const double sigma_m = options.degenerate_sigma_m;
  if (condition.smallest_eigenvalue * sigma_m * sigma_m < 1.0) {
    statistics->flags |= kFlagDegenerate;
  }
}

}  // namespace trajlo
