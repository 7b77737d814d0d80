// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/odometry/trajectory/trajectory.h"
#include "core/report/pose_flags.h"

namespace trajlo::python {

/// A trajectory, of which it is known or not whether its poses have flags: only the estimator sets
/// them, and most files do not tell.
class FlaggedTrajectory : public Trajectory {
 public:
  FlaggedTrajectory() = default;
  explicit FlaggedTrajectory(const Trajectory& poses) : Trajectory(poses) {}
  /// With known flags, those at its times.
  FlaggedTrajectory(const Trajectory& poses, const PoseFlags& flags) : has_flags_(true) {
    for (ControlPose pose : poses.poses()) {
      pose.flags = flags.At(pose.t_ns);
      Append(pose);
    }
  }

  bool has_flags() const { return has_flags_; }

 private:
  bool has_flags_ = false;
};

}  // namespace trajlo::python
