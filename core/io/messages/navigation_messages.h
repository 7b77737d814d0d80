// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/io/messages/message_header.h"
#include "core/io/messages/raw_message.h"
#include "core/io/trajectory_reader.h"
#include "manifolds/se3.h"

namespace trajlo {

/// T_parent_child: where the child frame is.
struct StampedTransform {
  std::int64_t t_ns = 0;
  std::string parent, child;
  SE3 T_parent_child;
};

/// tf2_msgs/TFMessage.
std::string WriteTransforms(const std::vector<StampedTransform>& transforms, Encoding encoding);

/// nav_msgs/Path with the poses of the body in the header's frame.
std::string WritePath(const MessageHeader& header, const std::vector<StampedPose>& poses,
                      Encoding encoding);

/// What an Odometry says about one pose.
struct OdometryState {
  SE3 T_world_body;
  /// Of the body, in the body frame: m/s and rad/s.
  Vector6d velocity = Vector6d::Zero();
  /// Of the right perturbation [rho; theta] of T_world_body: m², m rad, rad².
  std::optional<Matrix6d> covariance;
};

/// nav_msgs/Odometry of `body_frame` in the header's frame. The covariance is turned to what ROS
/// means: of the position along, and of rotations about, the fixed axes of the header's frame. What
/// is not known is zero.
std::string WriteOdometry(const MessageHeader& header, const std::string& body_frame,
                          const OdometryState& state, Encoding encoding);

}  // namespace trajlo
