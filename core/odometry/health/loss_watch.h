// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "core/odometry/health/window_statistics.h"
#include "core/options/describe.h"

namespace trajlo {

struct LostOptions {
  double min_inlier_share = 0.3;
  double max_duration_s = 1.0;
  /// After a pause, or when a covered LiDAR sees again, the place is sought in the map. When so
  /// much data has come and it is not found, the estimator is lost.
  static constexpr double kMaxSearch_s = 5.0;
  double degenerate_sigma_m = 0.1;

  template <typename Describer>
  void Describe(Describer& d) {
    d(OptionFor::kExperts, "min_inlier_share", min_inlier_share, Range<double>{0.0, 1.0},
      "The estimator is lost when fewer than this share of the points have a plane for longer "
      "than max_duration_s: the map grew with what was seen, and still does not explain it.");
    d(OptionFor::kExperts, "max_duration_s", max_duration_s, Range<double>{0.0, 1e6},
      "See min_inlier_share.");
    d(OptionFor::kExperts, "degenerate_sigma_m", degenerate_sigma_m, Range<double>{1e-4, 1e3},
      "A direction in which the points of a window hold it to a larger standard deviation counts "
      "as degenerate (a well-spread scene has 0.01).");
  }
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
    bool is_unsettled;
    bool is_doubtful;  ///< Unsettled, and a flag speaks against its pose.
  };
  bool TooFewInliers(const WindowStatistics& window);
  bool TooFewSettled(const WindowStatistics& window);
  double Share(bool Window::*what) const;

  LostOptions options_;
  std::optional<std::int64_t> few_since_ns_;
  std::deque<Window> recent_;  ///< Those of the last three seconds.
  bool span_is_full_ = false;
};

}  // namespace trajlo
