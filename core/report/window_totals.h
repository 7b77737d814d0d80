// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "core/odometry/health/window_statistics.h"

namespace trajlo {

/// Sums over the windows of a run.
struct WindowTotals {
  std::int64_t windows = 0;
  std::int64_t points = 0;
  std::int64_t inliers = 0;
  std::int64_t searched = 0;
  std::int64_t rounds = 0;
  std::int64_t iterations = 0;
  double segment_ms = 0.0;
  double associate_ms = 0.0;
  double solve_ms = 0.0;
  double marginalize_ms = 0.0;
  double map_ms = 0.0;
  /// How many windows had each flag, by its name; those that never occurred included.
  std::map<std::string, std::int64_t> flags;
  /// How many of the degenerate windows are weakest along each axis (see AxisName).
  std::map<std::string, std::int64_t> weak_axes;

  WindowTotals();
  void Add(const WindowStatistics& window);

  /// `sum` per window; 0 without windows.
  double Mean(std::int64_t sum) const {
    return windows > 0 ? static_cast<double>(sum) / static_cast<double>(windows) : 0.0;
  }
  double InlierShare() const {
    return points > 0 ? static_cast<double>(inliers) / static_cast<double>(points) : 0.0;
  }
};

}  // namespace trajlo
