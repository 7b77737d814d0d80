// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace trajlo {

/// What a bag says about the messages of a topic.
struct MessageDescription {
  /// As ROS 1 says it: "sensor_msgs/PointCloud2".
  std::string type;
  /// Of ROS 1; bags of ROS 2 know none.
  std::string md5sum;
  /// The text of the interface with all interfaces that it is made of. Empty: unknown.
  std::string definition;
  /// That of the text: "ros1msg", "ros2msg" or "ros2idl".
  std::string language = "ros1msg";
};

/// A topic as a bag announces it.
struct TopicDescription {
  std::string name;
  MessageDescription message;
  /// Who comes late gets the last message all the same.
  bool is_latched = false;
  /// ROS 2's qualities of service, as another bag has them; empty: those that `is_latched` means.
  std::string qos{};
};

/// "sensor_msgs/msg/PointCloud2"
std::string Ros2TypeName(std::string_view type);

/// The interface as ROS 2 has it: no seq in headers, times as builtin_interfaces. Constants and
/// comments stay.
std::string Ros2Definition(std::string_view ros1_definition);

/// The interfaces that we write. Their MD5 sums are the published ones, which depend on fields and
/// constants only.
const MessageDescription& PointCloud2Description();
const MessageDescription& LivoxCustomMsgDescription();
const MessageDescription& PoseStampedDescription();
const MessageDescription& OdometryDescription();
const MessageDescription& PathDescription();
const MessageDescription& TfMessageDescription();
/// That of these with such a type, by its name in ROS 1 or ROS 2; null if there is none.
const MessageDescription* FindDescription(std::string_view type);

}  // namespace trajlo
