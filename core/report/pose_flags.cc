// SPDX-License-Identifier: MIT
#include "core/report/pose_flags.h"

#include <algorithm>

#include "core/io/stamp_text.h"
#include "core/report/window_csv.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {

PoseFlags::PoseFlags(const std::vector<ControlPose>& poses,
                     std::optional<std::int64_t> lost_at_ns) {
  struct Counter {
    unsigned bits;
    FlaggedPoses* total;
    double on_end_s = 0.0;
  };
  std::vector<Counter> counters = {{~0U, &any_}};
  for (const unsigned flag : kAllFlags) counters.push_back({flag, &totals_[FlagNames(flag)]});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const bool is_lost = lost_at_ns && poses[i].t_ns >= *lost_at_ns;
    const unsigned flags = poses[i].flags | (is_lost ? kFlagLost : 0U);
    poses_.push_back({poses[i].t_ns, flags});
    const double duration_s = i > 0 ? Seconds(poses[i].t_ns - poses[i - 1].t_ns) : 0.0;
    seconds_ += duration_s;
    for (auto& [bits, total, on_end_s] : counters) {
      if ((flags & bits) == 0) {
        on_end_s = 0.0;
        continue;
      }
      on_end_s += duration_s;
      ++total->poses;
      ++total->control_poses;
      total->seconds += duration_s;
      total->longest_s = std::max(total->longest_s, on_end_s);
    }
  }
}

void PoseFlags::CountPosesAt(const std::vector<std::int64_t>& times_ns) {
  any_.poses = 0;
  for (auto& [name, total] : totals_) total.poses = 0;
  for (const std::int64_t t_ns : times_ns) {
    const unsigned flags = At(t_ns);
    any_.poses += flags != 0 ? 1 : 0;
    for (const unsigned flag : kAllFlags) {
      totals_[FlagNames(flag)].poses += (flags & flag) != 0 ? 1 : 0;
    }
  }
}

unsigned PoseFlags::At(std::int64_t t_ns) const {
  if (poses_.empty()) return 0;
  const auto found =
      std::lower_bound(poses_.begin(), poses_.end(), t_ns,
                       [](const Flagged& pose, std::int64_t t) { return pose.t_ns < t; });
  return found != poses_.end() ? found->flags : poses_.back().flags;
}

std::string FlagsCsv(const PoseFlags& flags, const std::vector<std::int64_t>& times_ns) {
  std::string text = "t_s,flags,flag_names\n";
  for (const std::int64_t t_ns : times_ns) {
    const unsigned bits = flags.At(t_ns);
    text += FormatSeconds(t_ns) + "," + std::to_string(bits) + "," + FlagNames(bits) + "\n";
  }
  return text;
}

}  // namespace trajlo
