// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/odometry/segments/segment_cloud.h"
#include "core/odometry/start/initial_motion.h"
#include "core/scans/nanoseconds.h"
#include "manifolds/se3.h"

namespace trajlo {

/// Where the first interval leaves a direction open, this much more is waited for: FindFirstSpeed.
constexpr double kSpeedSearch_s = 2.4;

/// What a map begins with: the segments of the first interval, as far as they have come, and those
/// behind it that are needed to know the motion.
struct Beginning {
  std::vector<SegmentCloud> segments;
  SE3 T_world_begin;
  unsigned flags = 0;  ///< Of the first pose.
  /// What the first interval alone, of `in_interval` segments, tells, once it has come.
  std::optional<FirstMotion> motion = std::nullopt;
  std::size_t in_interval = 0;
  bool is_cut_short = false;  ///< The recording ended before the first interval was whole.

  /// Whether they tell how the body moved: they last `first_interval_s`, and longer if that left a
  /// direction open; or are two scans of one time each.
  bool IsWhole(const InitializationOptions& options) const {
    if (segments.empty()) return false;
    if (segments.front().is_instant) return segments.size() >= 2;
    // Times are whole nanoseconds: ten times 0.03 s may be a little less than 0.3 s.
    constexpr double kRounding_s = 1e-6;
    const double needed_s = options.first_interval_s + (motion ? kSpeedSearch_s : 0.0);
    return Seconds(segments.back().end_ns - segments.front().begin_ns) > needed_s - kRounding_s;
  }
};

}  // namespace trajlo
