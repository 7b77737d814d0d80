// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>

#include "core/odometry/health/window_statistics.h"

namespace trajlo {

/// Notices windows in which few points have a plane of the map. How many have one depends on the
/// sensor and on the place: by much on rain, leaves and other clutter, by little on the motion. So
/// few are those that would be few anywhere, and those that are far below what is usual here.
class InlierWatch {
 public:
  /// Fewer than `min_share` are few anywhere.
  explicit InlierWatch(double min_share) : min_share_(min_share) {}

  /// Takes the next window; true if few of its points have a plane.
  bool HasFew(const WindowStatistics& window);

 private:
  struct Window {
    std::int64_t end_ns;
    double share;
  };
  double Usual() const;

  double min_share_;
  std::deque<Window> recent_;  ///< Those of the last ten seconds.
};

}  // namespace trajlo
