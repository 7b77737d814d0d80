// SPDX-License-Identifier: MIT
#include <vector>

#include "core/io/ros1/ros1_bag_reader.h"
#include "tests/core/io/ros1/ros1_testing.h"

namespace trajlo::testing {
namespace {

struct Recording {
  const char* file;
  std::vector<Topic> topics;
  std::uint64_t bytes;
};

// The numbers are those of the Python package rosbags 0.11.9.
const Recording kRecordings[] = {
    {"corridor_vlp16.bag",
     {{"/leica/pose/relative", "geometry_msgs/PoseStamped", Encoding::kRos1, 251},
      {"/velodyne_points", "sensor_msgs/PointCloud2", Encoding::kRos1, 25}},
     15835345},
    {"square_os1_16x2.bag",
     {{"/leica/pose/relative", "geometry_msgs/PoseStamped", Encoding::kRos1, 401},
      {"/os1_cloud_node1/points", "sensor_msgs/PointCloud2", Encoding::kRos1, 40},
      {"/os1_cloud_node2/points", "sensor_msgs/PointCloud2", Encoding::kRos1, 39}},
     62175121},
    {"swing_avia.bag",
     {{"/leica/pose/relative", "geometry_msgs/PoseStamped", Encoding::kRos1, 401},
      {"/livox/lidar", "livox_ros_driver/CustomMsg", Encoding::kRos1, 40}},
     18234766},
};

TEST(Recordings, HaveTheTopicsMessagesAndBytesThatAnotherReaderFinds) {
  for (const Recording& recording : kRecordings) {
    const auto path = SimulatedDir() / recording.file;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
    Ros1BagReader reader(path);
    std::vector<Topic> found = reader.topics();
    for (Topic& topic : found) topic.messages = 0;
    std::uint64_t bytes = 0;
    std::int64_t last_ns = 0;
    RawMessage message;
    while (reader.Next(&message)) {
      ++found[message.topic].messages;
      bytes += message.bytes.size();
      EXPECT_LE(last_ns, message.recorded_ns);
      last_ns = message.recorded_ns;
    }
    EXPECT_FALSE(reader.report().damaged);
    EXPECT_EQ(bytes, recording.bytes) << recording.file;
    ASSERT_EQ(found.size(), recording.topics.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].name, recording.topics[i].name);
      EXPECT_EQ(found[i].type, recording.topics[i].type);
      EXPECT_EQ(found[i].messages, recording.topics[i].messages);
      EXPECT_EQ(reader.topics()[i].messages, recording.topics[i].messages);
    }
  }
}

}  // namespace
}  // namespace trajlo::testing
