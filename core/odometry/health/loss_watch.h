// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "core/odometry/health/window_statistics.h"

namespace trajlo {

/// Notices when the estimator stops following the scene. A trajectory that is wrong looks smooth
/// and has many inliers; what gives it away is that its windows do not settle, or that few
/// points have a plane for a second.
class LossWatch {
 public:
  /// Takes the next window; the time at which the loss began, if this window is lost.
  std::optional<std::int64_t> Update(const WindowStatistics& window);

 private:
  struct Past {
    std::int64_t end_ns;
    bool is_unsettled;
    bool is_doubtful;  ///< Unsettled, and a flag speaks against its pose.
  };
  bool TooFewInliers(const WindowStatistics& window);
  bool TooFewSettled(const WindowStatistics& window);
  double Share(bool Past::*what) const;

  std::optional<std::int64_t> few_since_ns_;
  std::deque<Past> recent_;  ///< Those of the last three seconds, twenty at least.
  bool span_is_full_ = false;
};

}  // namespace trajlo
