// SPDX-License-Identifier: MIT
#include "core/odometry/trajectory/final_poses.h"

namespace trajlo {

void FinalPoses::Append(const LeavingPose& pose) {
  if (first_) Append({*std::exchange(first_, std::nullopt)});
  trajectory_.Append(pose.pose);
  if (on_pose_) to_hand_on_.push_back(pose);
}

void FinalPoses::HandOn() {
  while (!to_hand_on_.empty()) {
    const LeavingPose pose = to_hand_on_.front();
    to_hand_on_.pop_front();
    on_pose_(pose.pose, pose.covariance);
  }
}

}  // namespace trajlo
