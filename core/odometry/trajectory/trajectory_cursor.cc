// SPDX-License-Identifier: MIT
#include "core/odometry/trajectory/trajectory_cursor.h"

#include <algorithm>
#include <vector>

namespace trajlo {

TrajectoryCursor::Time TrajectoryCursor::MoveTo(std::int64_t t_ns) {
  const std::vector<ControlPose>& poses = trajectory_->poses();
  if (poses.empty() || t_ns < poses.front().t_ns || t_ns > poses.back().t_ns) {
    return Time::kOutside;
  }
  if (t_ns <= begin_ns_ || t_ns > end_ns_) {
    const auto end =
        std::lower_bound(poses.begin(), poses.end(), t_ns,
                         [](const ControlPose& pose, std::int64_t t) { return pose.t_ns < t; });
    auto begin = end == poses.begin() ? end : end - 1;
    if (end->t_ns - begin->t_ns > max_gap_ns_) {
      if (t_ns < end->t_ns) return Time::kInPause;
      begin = end;
    }
    begin_ns_ = begin->t_ns;
    end_ns_ = end->t_ns;
    motion_ = SegmentMotion(begin->T_world_body, end->T_world_body);
  }
  alpha_ = end_ns_ > begin_ns_
               ? static_cast<double>(t_ns - begin_ns_) / static_cast<double>(end_ns_ - begin_ns_)
               : 1.0;
  return Time::kCovered;
}

}  // namespace trajlo
