// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "core/io/messages/cloud_decoder.h"
#include "core/io/messages/ros_cloud_reader.h"
#include "core/io/ros2/rosbag2_reader.h"
#include "tests/core/io/io_testing.h"

namespace trajlo {

/// A message with its topic's name, for comparing containers.
struct NamedMessage {
  std::string topic;
  std::string type;
  std::int64_t recorded_ns;
  std::string bytes;

  bool operator==(const NamedMessage& o) const {
    return std::tie(topic, type, recorded_ns, bytes) ==
           std::tie(o.topic, o.type, o.recorded_ns, o.bytes);
  }
};

inline std::vector<NamedMessage> ReadAll(RawMessageReader* reader) {
  std::vector<NamedMessage> messages;
  RawMessage raw;
  while (reader->Next(&raw)) {
    const Topic& topic = reader->topics().at(raw.topic);
    messages.push_back({topic.name, topic.type, raw.recorded_ns, std::string(raw.bytes.view())});
  }
  return messages;
}

inline std::vector<NamedMessage> ReadAll(const std::filesystem::path& path) {
  Rosbag2Reader reader(path);
  return ReadAll(&reader);
}

/// The clouds of each topic.
inline std::map<std::string, std::vector<CloudMessage>> ReadClouds(
    const std::filesystem::path& path, MessageReport* report = nullptr) {
  RosCloudReader reader(std::make_unique<Rosbag2Reader>(path), path);
  std::map<std::string, std::vector<CloudMessage>> clouds;
  CloudMessage cloud;
  while (reader.Next(&cloud)) {
    clouds[reader.topics()[cloud.topic].name].push_back(std::move(cloud));
    cloud = {};
  }
  if (report != nullptr) *report = reader.report();
  return clouds;
}

inline const Topic* FindTopic(const RawMessageReader& reader, const std::string& name) {
  for (const Topic& topic : reader.topics()) {
    if (topic.name == name) return &topic;
  }
  return nullptr;
}

}  // namespace trajlo
