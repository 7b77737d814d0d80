// SPDX-License-Identifier: MIT
#include "core/io/messages/pose_decoder.h"

#include "core/io/finite_pose.h"
#include "core/io/messages/message_header.h"
#include "core/io/messages/wire_reader.h"

namespace trajlo {
namespace {

/// What stands between the header and the position, and whether a rotation follows.
struct PoseLayout {
  const char* type;
  bool has_child_frame;
  bool has_rotation;
};

constexpr PoseLayout kLayouts[] = {{"geometry_msgs/PoseStamped", false, true},
                                   {"geometry_msgs/PoseWithCovarianceStamped", false, true},
                                   {"geometry_msgs/TransformStamped", true, true},
                                   {"geometry_msgs/PointStamped", false, false},
                                   {"nav_msgs/Odometry", true, true}};

const PoseLayout* FindLayout(std::string_view type) {
  for (const PoseLayout& layout : kLayouts) {
    if (type == layout.type) return &layout;
  }
  return nullptr;
}

}  // namespace

bool IsPoseType(std::string_view type) { return FindLayout(type) != nullptr; }

std::optional<StampedPose> DecodePose(std::string_view type, Encoding encoding,
                                      std::string_view bytes) {
  const PoseLayout* layout = FindLayout(type);
  if (layout == nullptr) return {};
  WireReader reader(bytes, encoding);
  StampedPose pose;
  pose.t_ns = ReadMessageHeader(&reader).stamp_ns;
  if (layout->has_child_frame) reader.ReadString();
  for (int i = 0; i < 3; ++i) pose.T_world_body.t[i] = reader.Read<double>();
  if (layout->has_rotation) {
    // x, y, z, w, as Eigen stores them.
    for (int i = 0; i < 4; ++i) pose.T_world_body.q.coeffs()[i] = reader.Read<double>();
  }
  if (!reader.ok() || !HasFiniteLength(pose.T_world_body)) return {};
  // rospy's default, and so what a total station sends that knows no rotation.
  pose.has_rotation = layout->has_rotation && pose.T_world_body.q.norm() >= 1e-9;
  if (!pose.has_rotation) pose.T_world_body.q.setIdentity();
  pose.T_world_body.q.normalize();
  return pose;
}

}  // namespace trajlo
