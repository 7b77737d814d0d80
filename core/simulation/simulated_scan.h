// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/scans/lidar_scan.h"

namespace trajlo::simulation {

/// A scan as a reader would deliver it, and what only the simulator knows about it.
struct SimulatedScan {
  /// Times are those of the LiDAR's clock, with all faults.
  LidarScan scan;
  /// What the offsets of the points count from, in the same clock: the start of the sweep.
  std::int64_t sweep_start_ns = 0;
  std::int64_t period_ns = 0;
  /// The true time at which the sweep started, and its number within this LiDAR's stream.
  std::int64_t true_start_ns = 0;
  std::int64_t index = 0;

  /// A millisecond after the end of the sweep, by a clock that is right.
  std::int64_t RecordedNs() const { return true_start_ns + period_ns + 1'000'000; }
};

}  // namespace trajlo::simulation
