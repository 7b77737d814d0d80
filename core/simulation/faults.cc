// SPDX-License-Identifier: MIT
#include "core/simulation/faults.h"

#include <limits>

#include "core/scans/nanoseconds.h"
#include "core/simulation/random/counter_random.h"

namespace trajlo::simulation {

namespace {}  // namespace

bool FaultInjector::Apply(SimulatedScan* simulated) {
  LidarScan& scan = simulated->scan;
  CounterRandom random(seed_, 0xfa017, static_cast<std::uint64_t>(scan.lidar_id),
                       static_cast<std::uint64_t>(simulated->index));
  // Every kind draws whether it is switched on or not, so that one fault does not change another.
  const bool drop = random.Uniform() < config_.dropped_scan_fraction;
  const bool duplicate = random.Uniform() < config_.duplicate_stamp_fraction;
  const bool backward = random.Uniform() < config_.backward_stamp_fraction;
  const double jitter_s = config_.stamp_jitter_s * random.Gaussian();

  const std::int64_t true_start_ns = simulated->true_start_ns;
  const bool silent = scan.lidar_id == config_.silent_lidar &&
                      true_start_ns >= start_ns_ + Nanoseconds(config_.silent_from_s) &&
                      true_start_ns < start_ns_ + Nanoseconds(config_.silent_until_s);
  const bool paused = IsWithin(true_start_ns, config_.pause_from_s, config_.pause_s);
  if (drop || silent || paused) return false;

  for (LidarPoint& point : scan.points) {
    const std::int64_t true_ns = true_start_ns + point.t_ns - simulated->sweep_start_ns;
    if (!IsWithin(true_ns, config_.cover_from_s, config_.cover_s)) continue;
    point.xyz_m *= static_cast<float>(config_.cover_m) / point.xyz_m.norm();
  }

  std::int64_t shift_ns = Nanoseconds(jitter_s);
  const std::int64_t end_ns = config_.end_of_sweep_stamps ? simulated->period_ns : 0;
  const auto previous = previous_stamp_ns_.find(scan.lidar_id);
  if (previous != previous_stamp_ns_.end()) {
    const std::int64_t to_previous_ns = previous->second - (scan.stamp_ns + end_ns);
    if (duplicate) shift_ns = to_previous_ns;
    if (backward) shift_ns = to_previous_ns - Nanoseconds(config_.backward_step_s);
  }
  scan.stamp_ns += end_ns + shift_ns;
  simulated->sweep_start_ns += shift_ns;
  previous_stamp_ns_[scan.lidar_id] = scan.stamp_ns;

  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (LidarPoint& point : scan.points) {
    point.t_ns += shift_ns;
    if (config_.nan_point_fraction > 0.0 && random.Uniform() < config_.nan_point_fraction) {
      point.xyz_m.setConstant(kNan);
    }
  }
  return true;
}

bool FaultInjector::IsWithin(std::int64_t true_ns, double from_s, double duration_s) const {
  return true_ns >= start_ns_ + Nanoseconds(from_s) &&
         true_ns < start_ns_ + Nanoseconds(from_s + duration_s);
}

bool FaultInjector::Repeats(const SimulatedScan& simulated) const {
  CounterRandom random(seed_, 0x4e9ea7, static_cast<std::uint64_t>(simulated.scan.lidar_id),
                       static_cast<std::uint64_t>(simulated.index));
  return random.Uniform() < config_.repeated_scan_fraction;
}

}  // namespace trajlo::simulation
