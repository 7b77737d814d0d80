// SPDX-License-Identifier: MIT
#include "core/odometry/weights/adaptive_threshold.h"

#include <algorithm>
#include <cmath>

namespace trajlo {

AdaptiveThreshold::AdaptiveThreshold(const AdaptiveThresholdOptions& options)
    : options_(options), mean_square_m2_(options.initial_m * options.initial_m) {}

void AdaptiveThreshold::AddPredictionError(const SE3& error) {
  const double angle = so3::Log(error.q).norm();
  const double error_m = error.t.norm() + 2.0 * options_.range_m * std::sin(0.5 * angle);
  if (!std::isfinite(error_m) || error_m < options_.min_motion_m) return;
  mean_square_m2_ += options_.forgetting * (error_m * error_m - mean_square_m2_);
}

double AdaptiveThreshold::threshold_m() const {
  if (!options_.adaptive) return options_.initial_m;
  return std::clamp(std::sqrt(mean_square_m2_), options_.min_m, options_.max_m);
}

}  // namespace trajlo
