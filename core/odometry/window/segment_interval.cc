// SPDX-License-Identifier: MIT
#include "core/odometry/window/segment_interval.h"

#include <cmath>

#include "core/odometry/window/window_statistics.h"

namespace trajlo {

std::optional<double> MeasureAcceleration(const Trajectory& trajectory, double baseline_s,
                                          double lever_arm_m) {
  if (trajectory.empty()) return std::nullopt;
  const ControlPose& newest = trajectory.poses().back();
  const std::int64_t baseline_ns = std::llround(baseline_s * 1e9);
  if (newest.flags & (kFlagNotConverged | kFlagReverted)) return std::nullopt;
  const std::optional<SE3> middle = trajectory.At(newest.t_ns - baseline_ns);
  const std::optional<SE3> oldest = trajectory.At(newest.t_ns - 2 * baseline_ns);
  if (!middle || !oldest) return std::nullopt;
  const Vector6d before = Minus(*middle, *oldest) / baseline_s;
  const Vector6d after = Minus(newest.T_world_body, *middle) / baseline_s;
  const Vector6d change = (after - before) / baseline_s;
  return change.head<3>().norm() + lever_arm_m * change.tail<3>().norm();
}

int ChooseSlots(const AdaptiveIntervalOptions& options, double slot_s, double acceleration_m_s2,
                int current) {
  for (int slots = options.divisions; slots > 1; --slots) {
    const double interval_s = slots * slot_s;
    const double reserve = slots > current ? options.reserve : 1.0;
    const double deviation_m = acceleration_m_s2 * interval_s * interval_s / 8.0;
    if (reserve * deviation_m <= options.max_deviation_m) return slots;
  }
  return 1;
}

SegmentInterval::SegmentInterval(const AdaptiveIntervalOptions& options, double longest_s)
    : options_(options),
      slot_s_(longest_s / options.divisions),
      baseline_s_(longest_s * options.baseline_in_intervals) {
  Reset();
}

void SegmentInterval::Reset() {
  mean_square_m2_s4_ = 0.0;
  slots_ = options_.divisions;
}

void SegmentInterval::Update(const Trajectory& recent, double duration_s) {
  const double acceleration =
      MeasureAcceleration(recent, baseline_s_, options_.lever_arm_m).value_or(0.0);
  const double newest_share = 1.0 - std::exp(-duration_s / options_.memory_s);
  mean_square_m2_s4_ += newest_share * (acceleration * acceleration - mean_square_m2_s4_);
  slots_ = ChooseSlots(options_, slot_s_, std::sqrt(mean_square_m2_s4_), slots_);
}

}  // namespace trajlo
