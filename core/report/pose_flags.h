// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/odometry/trajectory/trajectory.h"

namespace trajlo {

/// How many poses have a flag, and how much time the control poses with it stand for: that from the
/// pose before to the flagged one.
struct FlaggedPoses {
  std::size_t poses = 0;
  std::size_t control_poses = 0;
  double seconds = 0.0;
  double longest_s = 0.0;  ///< The longest such time on end.
};

/// What can be said against the poses of a trajectory, once a run is over. A time between two
/// control poses has the flags of the later one; from `lost_at_ns` on, all are lost.
class PoseFlags {
 public:
  PoseFlags() : PoseFlags({}, std::nullopt) {}
  PoseFlags(const std::vector<ControlPose>& poses, std::optional<std::int64_t> lost_at_ns);

  /// Counts the poses at these times, those of a trajectory file, in place of the control poses.
  void CountPosesAt(const std::vector<std::int64_t>& times_ns);

  /// WindowFlag bits at a time within the trajectory; those of the last pose after it.
  unsigned At(std::int64_t t_ns) const;
  /// By the flag's name; those that never occurred included.
  const std::map<std::string, FlaggedPoses>& totals() const { return totals_; }
  /// With any flag.
  const FlaggedPoses& any() const { return any_; }
  /// The time of the whole trajectory.
  double seconds() const { return seconds_; }

 private:
  struct Flagged {
    std::int64_t t_ns;
    unsigned flags;
  };
  std::vector<Flagged> poses_;
  std::map<std::string, FlaggedPoses> totals_;
  FlaggedPoses any_;
  double seconds_ = 0.0;
};

/// One line for each of `times_ns`, those of the lines of a trajectory file: t_s,flags,flag_names.
std::string FlagsCsv(const PoseFlags& flags, const std::vector<std::int64_t>& times_ns);

}  // namespace trajlo
