// SPDX-License-Identifier: MIT
#include "core/io/conversion/scan_bag_writer.h"

#include <stdexcept>

#include "core/io/errors.h"

namespace trajlo {

std::optional<CloudLayout> ParseCloudLayout(std::string_view name) {
  if (name == "ouster") return CloudLayout::kOuster;
  if (name == "velodyne") return CloudLayout::kVelodyne;
  if (name == "livox") return CloudLayout::kLivox;
  return {};
}

std::string TopicOf(CloudLayout layout, std::size_t lidar, std::size_t lidars) {
  const std::string number = lidars > 1 ? std::to_string(lidar + 1) : "";
  switch (layout) {
    case CloudLayout::kOuster:
      return lidars > 1 ? "/os1_cloud_node" + number + "/points" : "/os_cloud_node/points";
    case CloudLayout::kVelodyne:
      return lidars > 1 ? "/velodyne" + number + "/velodyne_points" : "/velodyne_points";
    case CloudLayout::kLivox:
      return lidars > 1 ? "/livox/lidar_" + number : "/livox/lidar";
  }
  throw std::invalid_argument("unknown layout of point clouds");
}

MessageHeader ScanBagWriter::Header(const std::string& topic, const std::string& frame_id,
                                    std::int64_t stamp_ns) {
  return {messages_of_topic_[topic]++, stamp_ns, frame_id};
}

void ScanBagWriter::WriteScan(CloudLayout layout, const std::string& topic,
                              const std::string& frame_id, const Times& times,
                              const LidarScan& scan) {
  std::string message;
  try {
    message = WriteCloud(layout, Header(topic, frame_id, times.stamp_ns), times.sweep_start_ns,
                         scan, bag_->encoding());
  } catch (const std::invalid_argument& error) {
    throw OutputError(topic, error.what());
  }
  bag_->Write({topic, DescriptionOf(layout)}, times.recorded_ns, message);
}

void ScanBagWriter::WritePose(const std::string& topic, std::int64_t t_ns,
                              const SE3& T_world_body) {
  bag_->Write({topic, PoseStampedDescription()}, t_ns,
              WritePoseStamped(Header(topic, "world", t_ns), T_world_body, bag_->encoding()));
}

}  // namespace trajlo
