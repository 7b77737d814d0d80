// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "core/odometry/health/window_statistics.h"

namespace trajlo {

struct LostOptions {
  /// The estimator is lost when fewer than this share of the points find a plane ...
  double min_inlier_share = 0.05;
  /// ... for longer than this ...
  double max_duration_s = 1.0;
  /// ... or when of all windows of this time ...
  double convergence_span_s = 3.0;
  /// ... more than this share did not converge, or were reverted: planes that never settle are not
  /// those of the scene.
  double max_unconverged_share = 0.8;
  /// A solve that moves the newest pose farther than this from its prediction is not believed.
  double max_correction_m = 3.0;
  double max_correction_rad = 1.0;
  /// Below this information per point a direction counts as degenerate (a well-spread scene has
  /// 0.05 to 0.2).
  double degenerate_eigenvalue = 0.002;
};

/// Notices when the estimator stops following the scene. A trajectory that is wrong looks smooth
/// and has many inliers; what gives it away is that its windows do not settle.
class LossWatch {
 public:
  explicit LossWatch(const LostOptions& options) : options_(options) {}

  /// Takes the next window; the time at which the loss began, if this window is lost.
  std::optional<std::int64_t> Update(const WindowStatistics& window);

 private:
  struct Window {
    std::int64_t end_ns;
    bool is_settled;
    double squared_correction_m2;
  };
  bool TooFewInliers(const WindowStatistics& window);
  bool TooFewSettled(const WindowStatistics& window);

  LostOptions options_;
  std::optional<std::int64_t> few_since_ns_;
  std::deque<Window> recent_;  ///< Those of the last convergence_span_s.
  std::size_t unsettled_ = 0;  ///< Of these.
  bool span_is_full_ = false;
};

}  // namespace trajlo
