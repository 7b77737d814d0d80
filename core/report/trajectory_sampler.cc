// SPDX-License-Identifier: MIT
#include "core/report/trajectory_sampler.h"

#include <algorithm>
#include <cmath>

#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// The last segment ends at the last point that was kept; others of its scan may be a little later.
constexpr std::int64_t kEndTolerance = 1'000'000;

}  // namespace

void TrajectorySampler::NoteScan(const LidarScan& scan) {
  if (options_.at != SampleAt::kScanEnd && options_.at != SampleAt::kScanMid) return;
  if (scan.lidar_id != 0) return;
  std::int64_t first = scan.stamp_ns, last = scan.stamp_ns;
  if (scan.has_point_times && !scan.points.empty()) {
    const auto by_time = [](const LidarPoint& a, const LidarPoint& b) { return a.t_ns < b.t_ns; };
    const auto [min, max] = std::minmax_element(scan.points.begin(), scan.points.end(), by_time);
    first = min->t_ns;
    last = max->t_ns;
  }
  const std::int64_t t_ns = options_.at == SampleAt::kScanEnd ? last : first + (last - first) / 2;
  if (newest_scan_ns_ && t_ns <= *newest_scan_ns_) {
    ++scans_without_pose_;
    return;
  }
  newest_scan_ns_ = t_ns;
  scan_times_.push_back(t_ns);
}

void TrajectorySampler::Advance(const Trajectory& trajectory, const Visit& visit) {
  if (trajectory.empty()) return;
  switch (options_.at) {
    case SampleAt::kControlPoses:
      return AdvanceControlPoses(trajectory, visit);
    case SampleAt::kRate:
      return AdvanceRate(trajectory, visit);
    case SampleAt::kScanEnd:
    case SampleAt::kScanMid:
      return AdvanceScans(trajectory, visit);
  }
}

void TrajectorySampler::AdvanceControlPoses(const Trajectory& trajectory, const Visit& visit) {
  bool goes_on = true;
  for (; goes_on && next_ < trajectory.poses().size(); ++next_, ++written_) {
    goes_on = visit(trajectory.poses()[next_].t_ns, trajectory.poses()[next_].T_world_body);
  }
}

/// From the begin, not from the sample before: rounding must not add up.
std::int64_t TrajectorySampler::SampleTime(const Trajectory& trajectory) const {
  const double seconds = static_cast<double>(next_) / options_.rate_hz;
  return trajectory.poses().front().t_ns + Nanoseconds(seconds);
}

void TrajectorySampler::AdvanceRate(const Trajectory& trajectory, const Visit& visit) {
  const std::vector<ControlPose>& poses = trajectory.poses();
  const auto max_gap_ns = Nanoseconds(options_.max_gap_s);
  for (bool goes_on = true; goes_on;) {
    const std::int64_t t_ns = SampleTime(trajectory);
    while (next_pose_ < poses.size() && poses[next_pose_].t_ns < t_ns) ++next_pose_;
    if (next_pose_ == poses.size()) return;
    const std::int64_t pose_ns = poses[next_pose_].t_ns;
    const bool is_in_gap =
        next_pose_ > 0 && pose_ns > t_ns && pose_ns - poses[next_pose_ - 1].t_ns > max_gap_ns;
    if (is_in_gap) {
      const double seconds = Seconds(pose_ns - poses.front().t_ns);
      const auto behind = static_cast<std::size_t>(std::ceil(seconds * options_.rate_hz));
      next_ = std::max(next_ + 1, behind);
      continue;
    }
    goes_on = visit(t_ns, *trajectory.At(t_ns));
    ++written_;
    ++next_;
  }
}

void TrajectorySampler::AdvanceScans(const Trajectory& trajectory, const Visit& visit) {
  bool goes_on = true;
  while (goes_on && !scan_times_.empty() && scan_times_.front() <= trajectory.poses().back().t_ns) {
    const std::int64_t t_ns = scan_times_.front();
    scan_times_.pop_front();
    if (const auto T = trajectory.At(t_ns)) {
      goes_on = visit(t_ns, *T);
      ++written_;
    } else {
      ++scans_without_pose_;
    }
  }
}

void TrajectorySampler::Finish(const Trajectory& trajectory, const Visit& visit) {
  Advance(trajectory, visit);
  if (!trajectory.empty() && !scan_times_.empty() &&
      scan_times_.front() <= trajectory.poses().back().t_ns + kEndTolerance) {
    visit(scan_times_.front(), trajectory.poses().back().T_world_body);
    scan_times_.pop_front();
    ++written_;
  }
  scans_without_pose_ += scan_times_.size();
  scan_times_.clear();
}

}  // namespace trajlo
