// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>

#include "core/odometry/trajectory/trajectory.h"
#include "core/scans/lidar_scan.h"

namespace trajlo {

enum class SampleAt { kControlPoses, kRate, kScanEnd, kScanMid };

struct SamplingOptions {
  SampleAt at = SampleAt::kControlPoses;
  /// Only for kRate.
  double rate_hz = 0.0;
  /// Control poses farther apart have a gap between them, for which kRate gives no poses.
  double max_gap_s = 1.0;
};

/// Picks the poses to be written from a trajectory that grows. Scans of the first LiDAR are noted
/// as they are read, and give their pose as soon as the trajectory covers them.
class TrajectorySampler {
 public:
  /// False ends the visits of this call.
  using Visit = std::function<bool(std::int64_t t_ns, const SE3& T_world_body)>;

  explicit TrajectorySampler(const SamplingOptions& options) : options_(options) {}

  void NoteScan(const LidarScan& scan);
  /// Visits what has become available since the last call, in the order of time.
  void Advance(const Trajectory& trajectory, const Visit& visit);
  /// The trajectory grows no more: scans beyond its end get no pose. One whose last points lie in
  /// the last millisecond gets the last pose.
  void Finish(const Trajectory& trajectory, const Visit& visit);

  std::size_t written() const { return written_; }
  /// Scans that have no pose: repeated, out of order, or outside of the trajectory.
  std::size_t scans_without_pose() const { return scans_without_pose_; }

 private:
  void AdvanceControlPoses(const Trajectory& trajectory, const Visit& visit);
  std::int64_t SampleTime(const Trajectory& trajectory) const;
  void AdvanceRate(const Trajectory& trajectory, const Visit& visit);
  void AdvanceScans(const Trajectory& trajectory, const Visit& visit);

  SamplingOptions options_;
  std::size_t next_ = 0;                 ///< Control pose, or sample of the rate.
  std::size_t next_pose_ = 0;            ///< The control pose that follows the next sample.
  std::deque<std::int64_t> scan_times_;  ///< Not written yet, increasing.
  std::optional<std::int64_t> newest_scan_ns_;
  std::size_t written_ = 0;
  std::size_t scans_without_pose_ = 0;
};

}  // namespace trajlo
