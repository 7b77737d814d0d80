// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>

#include "core/io/messages/raw_message.h"

namespace trajlo {

/// A topic from what a ROS 2 container says about it: type "sensor_msgs/msg/PointCloud2" and
/// encoding "cdr" (or, in MCAP files made of ROS 1 bags, "ros1"). Messages of any other encoding
/// cannot be decoded, so it becomes a part of the type, by which nothing knows it:
/// "foxglove.PointCloud (protobuf)".
inline Topic MakeTopic(const std::string& name, std::string type, const std::string& encoding) {
  Topic topic;
  topic.name = name;
  if (const auto at = type.find("/msg/"); at != std::string::npos) type.erase(at, 4);
  topic.type = std::move(type);
  topic.encoding = encoding == "ros1" ? Encoding::kRos1 : Encoding::kCdr;
  if (encoding != "cdr" && encoding != "ros1") topic.type += " (" + encoding + ")";
  return topic;
}

/// What the container knows for copies: the text of the interface, its language ("ros2msg", ...),
/// and the qualities of service, by the numbers of rmw or by their names.
inline void SetInterface(const std::string& language, const std::string& text,
                         const std::string& qos, Topic* topic) {
  topic->interface.type = topic->type;
  topic->interface.language = language;
  topic->interface.definition = text;
  topic->qos = qos;
  topic->is_latched = qos.find("durability: 1") != std::string::npos ||
                      qos.find("durability: transient_local") != std::string::npos;
}

}  // namespace trajlo
