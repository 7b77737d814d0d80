// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "core/odometry/trajectory/trajectory.h"

namespace trajlo {

/// How long segments are is chosen from the motion.
struct AdaptiveIntervalOptions {
  /// Off: every segment has the configured length.
  bool enabled = false;
  /// The shortest segment is `segmenter.interval_s` over this; all lengths are multiples of it.
  int divisions = 3;
  /// The trajectory within a segment may bend away from constant velocity by this ...
  double max_deviation_m = 0.005;
  /// ... at a point this far away, which angular acceleration moves.
  double lever_arm_m = 5.0;
  /// Time between the velocities whose difference is the acceleration, in longest segments: over
  /// less, the noise of the poses looks like acceleration.
  double baseline_in_intervals = 3.0;
  /// Time over which motion is remembered.
  double memory_s = 0.2;
  /// Segments grow again only if the bound would hold with this factor to spare.
  double reserve = 1.3;
};

/// The acceleration (m/s²) of a point `lever_arm_m` away, by the change between the mean twists of
/// the last two stretches of `baseline_s` each. The twists are those of the body frame,
/// [rho; theta]: a constant turn on a circle is no change. Empty while the trajectory is shorter,
/// and if the window of its newest pose did not converge: then it is the estimate that moves.
std::optional<double> MeasureAcceleration(const Trajectory& trajectory, double baseline_s,
                                          double lever_arm_m);

/// How many slots of `slot_s` the next segment should have, from 1 to `options.divisions`: the most
/// for which the deviation a Δt² / 8 of the middle of a segment from constant velocity stays within
/// its bound. Growth beyond `current` needs a reserve.
int ChooseSlots(const AdaptiveIntervalOptions& options, double slot_s, double acceleration_m_s2,
                int current);

/// Remembers the acceleration, and how long segments are now.
class SegmentInterval {
 public:
  SegmentInterval(const AdaptiveIntervalOptions& options, double longest_s);

  /// Slots of the next segment.
  int slots() const { return slots_; }

  /// Takes the estimate after a segment of `duration_s`; `recent` ends with the newest control pose
  /// and needs to reach back by history_s(). Where the acceleration is unknown, what is
  /// remembered fades: short segments hold few points, which a weak geometry cannot spare.
  void Update(const Trajectory& recent, double duration_s);
  double history_s() const { return 2.0 * baseline_s_; }

  /// The estimate starts anew.
  void Reset();

 private:
  AdaptiveIntervalOptions options_;
  double slot_s_, baseline_s_;
  int slots_;
  double mean_square_m2_s4_;
};

}  // namespace trajlo
