// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/io/messages/message_writer.h"
#include "core/io/ros1/ros1_bag_writer.h"

namespace trajlo {

/// "ouster", "velodyne" or "livox"; nothing for other text.
std::optional<CloudLayout> ParseCloudLayout(std::string_view name);

/// The topic on which public recordings have the points of such a sensor, for number `lidar` of
/// `lidars` of this kind: /os_cloud_node/points, /os1_cloud_node1/points (as NTU VIRAL),
/// /velodyne_points, /livox/lidar, ...
std::string TopicOf(CloudLayout layout, std::size_t lidar, std::size_t lidars);

/// Writes scans and poses into a bag. Members throw OutputError.
class ScanBagWriter {
 public:
  explicit ScanBagWriter(std::unique_ptr<BagWriter> bag) : bag_(std::move(bag)) {}
  /// Of ROS 1.
  ScanBagWriter(const std::filesystem::path& path, const Ros1BagOptions& options)
      : bag_(std::make_unique<Ros1BagWriter>(path, options)) {}

  /// When a scan's message is stamped and recorded, and what its points' times count from.
  struct Times {
    std::int64_t stamp_ns = 0;
    std::int64_t sweep_start_ns = 0;
    std::int64_t recorded_ns = 0;
  };
  /// Points beyond what a layout can hold throw OutputError as well.
  void WriteScan(CloudLayout layout, const std::string& topic, const std::string& frame_id,
                 const Times& times, const LidarScan& scan);
  /// Stamped and recorded at `t_ns`.
  void WritePose(const std::string& topic, std::int64_t t_ns, const SE3& T_world_body);
  void Close() { bag_->Close(); }

 private:
  MessageHeader Header(const std::string& topic, const std::string& frame_id,
                       std::int64_t stamp_ns);

  std::unique_ptr<BagWriter> bag_;
  std::map<std::string, std::uint32_t> messages_of_topic_;
};

}  // namespace trajlo
