// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/odometry/segments/segment_cloud.h"
#include "core/odometry/start/initial_motion.h"
#include "core/scans/nanoseconds.h"
#include "manifolds/se3.h"

namespace trajlo {

/// What a map begins with: the segments of the first interval, as far as they have come.
struct Beginning {
  std::vector<SegmentCloud> segments;
  SE3 T_world_begin;
  unsigned flags = 0;  ///< Of the first pose.

  /// Whether they tell how the body moved: they last `first_interval_s`, or are two scans of one
  /// time each.
  bool IsWhole(const InitializationOptions& options) const {
    if (segments.empty()) return false;
    if (segments.front().is_instant) return segments.size() >= 2;
    // Times are whole nanoseconds: ten times 0.03 s may be a little less than 0.3 s.
    constexpr double kRounding_s = 1e-6;
    return Seconds(segments.back().end_ns - segments.front().begin_ns) >
           options.first_interval_s - kRounding_s;
  }
};

}  // namespace trajlo
