// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/io/messages/message_description.h"

namespace trajlo {

/// The qualities of service of a topic as rosbag2 stores them: YAML with the numbers of rmw. All
/// are reliable; latched ones are kept for those who come late.
inline std::string QosText(const TopicDescription& topic) {
  if (!topic.qos.empty()) return topic.qos;
  const std::string endless = "\n    sec: 9223372036\n    nsec: 854775807";
  return "- history: 1\n  depth: " + std::string(topic.is_latched ? "1" : "10") +
         "\n  reliability: 1\n  durability: " + (topic.is_latched ? "1" : "2") +
         "\n  deadline:" + endless + "\n  lifespan:" + endless +
         "\n  liveliness: 1\n  liveliness_lease_duration:" + endless +
         "\n  avoid_ros_namespace_conventions: false\n";
}

/// The text of the interface in a language of ROS 2; empty where it is not known.
inline std::string Ros2Text(const MessageDescription& message) {
  if (message.definition.empty() || message.language != "ros1msg") return message.definition;
  return Ros2Definition(message.definition);
}

/// "ros2msg" or "ros2idl"; empty where there is no text.
inline std::string Ros2Language(const MessageDescription& message) {
  if (message.definition.empty()) return "";
  return message.language == "ros1msg" ? "ros2msg" : message.language;
}

}  // namespace trajlo
