// SPDX-License-Identifier: MIT
#pragma once

#include "manifolds/se3.h"

namespace trajlo {

/// How far the prediction is usually off: it sets how far associations reach and how wide the
/// robust kernel is. Idea: Vizzo et al., KISS-ICP, 2023, section III-B.
struct AdaptiveThresholdOptions {
  bool adaptive = true;
  /// Used until there is evidence, and always if not adaptive.
  double initial_m = 0.6;
  double min_m = 0.3;
  double max_m = 1.5;
  /// Prediction errors below this say nothing about what is needed.
  double min_motion_m = 0.02;
  /// Lever arm with which a rotation error counts.
  double range_m = 20.0;
  /// Share of the newest error in the running mean of squares.
  double forgetting = 0.02;
};

class AdaptiveThreshold {
 public:
  explicit AdaptiveThreshold(const AdaptiveThresholdOptions& options);

  /// `error` = prediction⁻¹ · estimate of the newest control pose.
  void AddPredictionError(const SE3& error);
  double threshold_m() const;

 private:
  AdaptiveThresholdOptions options_;
  double mean_square_m2_;
};

}  // namespace trajlo
