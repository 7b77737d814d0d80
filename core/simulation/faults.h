// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>

#include "core/simulation/simulated_scan.h"

namespace trajlo::simulation {

/// What goes wrong on the way from the sensor to the recording. Fractions are probabilities, drawn
/// anew for every scan or point.
struct FaultConfig {
  double dropped_scan_fraction = 0.0;
  /// The scan comes twice.
  double repeated_scan_fraction = 0.0;
  /// Of the points, which are kept but become NaN.
  double nan_point_fraction = 0.0;
  /// The scan carries the stamp of the one before.
  double duplicate_stamp_fraction = 0.0;
  /// The stamp lies `backward_step_s` before that of the scan before.
  double backward_stamp_fraction = 0.0;
  double backward_step_s = 0.02;
  /// Standard deviation of normal noise on the stamps.
  double stamp_jitter_s = 0.0;
  /// A LiDAR (counted from 0; -1: none) that says nothing for a while.
  int silent_lidar = -1;
  double silent_from_s = 0.0;
  double silent_until_s = 0.0;
  /// For this long, nothing is recorded (from the start of the recording on; 0: never).
  double pause_from_s = 0.0;
  double pause_s = 0.0;
  /// For this long, all LiDARs look at a cover: every point is `cover_m` away.
  double cover_from_s = 0.0;
  double cover_s = 0.0;
  double cover_m = 0.6;
  /// Stamps mark the end of the sweep; the offsets of the points still count from its start.
  bool end_of_sweep_stamps = false;
};

/// Applies the faults to the scans of a recording, which must come in order for each LiDAR. A wrong
/// stamp moves the times of all points of the scan, as it does in a driver that adds offsets to it.
class FaultInjector {
 public:
  FaultInjector(const FaultConfig& config, std::uint64_t seed, std::int64_t start_ns)
      : config_(config), seed_(seed), start_ns_(start_ns) {}

  /// False if the scan is lost.
  bool Apply(SimulatedScan* simulated);
  /// Whether a scan that was not lost comes a second time, as it is.
  bool Repeats(const SimulatedScan& simulated) const;

 private:
  /// Whether a true time lies in a stretch of the recording.
  bool IsWithin(std::int64_t true_ns, double from_s, double duration_s) const;

  FaultConfig config_;
  std::uint64_t seed_;
  std::int64_t start_ns_;
  std::map<int, std::int64_t> previous_stamp_ns_;
};

}  // namespace trajlo::simulation
