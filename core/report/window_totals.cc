// SPDX-License-Identifier: MIT
#include "core/report/window_totals.h"

#include "core/report/window_csv.h"

namespace trajlo {

WindowTotals::WindowTotals() {
  for (const unsigned flag : kAllFlags) flags[FlagNames(flag)] = 0;
}

void WindowTotals::Add(const WindowStatistics& window) {
  ++windows;
  points += window.points;
  inliers += window.inliers;
  searched += window.searched;
  rounds += window.rounds;
  iterations += window.iterations;
  segment_ms += window.milliseconds_segment;
  associate_ms += window.milliseconds_associate;
  solve_ms += window.milliseconds_solve;
  marginalize_ms += window.milliseconds_marginalize;
  map_ms += window.milliseconds_map;
  for (const unsigned flag : kAllFlags) {
    flags[FlagNames(flag)] += (window.flags & flag) != 0 ? 1 : 0;
  }
  if ((window.flags & kFlagDegenerate) != 0) {
    const std::string axis = AxisName(window.weak_direction);
    if (!axis.empty()) ++weak_axes[axis];
  }
}

}  // namespace trajlo
