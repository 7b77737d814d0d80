// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>

#include "core/odometry/health/window_statistics.h"

namespace trajlo {

/// Notices that too few points agree with the map:
///   - Few have a plane. How many have one depends on the sensor and on the place: by much on rain,
///     leaves and other clutter, by little on the motion. So few are those that would be few
///     anywhere, and those that are far below what is usual here.
///   - Few of those that have one lie on it, in some direction (MapAgreement::worst). A trajectory
///     with a wrong velocity builds a map of its own: on a street, ground and walls agree with any
///     speed, and only what stands across does not.
class InlierWatch {
 public:
  /// Takes the next window; true if too few of its points agree with the map.
  bool HasFew(const WindowStatistics& window);

 private:
  struct Past {
    std::int64_t end_ns;
    double share;
    double agreement;
  };
  /// The lower median since `begin_ns`.
  double Usual(double Past::*value, std::int64_t begin_ns) const;

  std::deque<Past> recent_;  ///< Those of the last ten seconds.
};

}  // namespace trajlo
