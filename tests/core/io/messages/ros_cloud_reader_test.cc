// SPDX-License-Identifier: MIT
#include "core/io/messages/ros_cloud_reader.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/core/io/messages/messages_testing.h"

namespace trajlo {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::int64_t kStartNs = 1'600'000'000'000'000'000;

/// A bag in memory.
class MemoryBag : public RawMessageReader {
 public:
  void Add(std::size_t topic, std::string bytes) {
    messages_.emplace_back(topic, std::move(bytes));
  }

  const std::vector<Topic>& topics() const override { return topics_; }
  void Select(const std::vector<std::size_t>& topics) override { selected_ = topics; }
  bool Next(RawMessage* message) override {
    for (; next_ < messages_.size(); ++next_) {
      const auto& [topic, bytes] = messages_[next_];
      if (std::count(selected_.begin(), selected_.end(), topic) == 0) continue;
      message->topic = topic;
      message->recorded_ns = static_cast<std::int64_t>(next_);
      message->bytes = ToFileBytes(bytes);
      ++next_;
      return true;
    }
    report_ = {true, 500, {"the bag is cut"}};
    return false;
  }
  const MessageReport& report() const override { return report_; }

 private:
  std::vector<Topic> topics_ = {{"/imu", "sensor_msgs/Imu", Encoding::kRos1, 1},
                                {"/points", "sensor_msgs/PointCloud2", Encoding::kRos1, 4},
                                {"/livox", "livox_ros_driver/CustomMsg", Encoding::kRos1, 2}};
  std::vector<std::pair<std::size_t, std::string>> messages_;
  std::vector<std::size_t> selected_;
  std::size_t next_ = 0;
  MessageReport report_;
};

std::unique_ptr<MemoryBag> MakeBag() {
  auto bag = std::make_unique<MemoryBag>();
  const LidarScan scan = MakeScan(5, kStartNs);
  const std::string cloud = WriteCloud(CloudLayout::kOuster, {0, kStartNs, ""}, kStartNs, scan);
  const std::string late =
      WriteCloud(CloudLayout::kLivox, {0, kStartNs + 100'000'000, ""}, kStartNs, scan);
  bag->Add(0, "imu");
  bag->Add(1, cloud);
  bag->Add(2, late);
  bag->Add(1, cloud.substr(0, 20));
  bag->Add(2, late);
  bag->Add(1, cloud.substr(0, 10));
  bag->Add(1, cloud);
  return bag;
}

std::vector<std::size_t> ReadTopics(RosCloudReader* reader) {
  std::vector<std::size_t> topics;
  CloudMessage cloud;
  while (reader->Next(&cloud)) {
    EXPECT_EQ(cloud.table.count, 5U);
    topics.push_back(cloud.topic);
  }
  return topics;
}

TEST(RosCloudReader, GivesCloudsAndReportsWhatIsNone) {
  RosCloudReader reader(MakeBag(), "my.bag");
  EXPECT_FALSE(reader.IsCloud(0));
  EXPECT_TRUE(reader.IsCloud(1));
  EXPECT_FALSE(reader.IsCloud(99));
  EXPECT_THAT(ReadTopics(&reader), ElementsAre(1, 2, 2, 1));
  EXPECT_TRUE(reader.report().damaged);
  EXPECT_EQ(reader.report().bytes_lost, 530U);
  EXPECT_THAT(reader.report().warnings,
              ElementsAre(HasSubstr("my.bag: topic /livox: the header's stamp"),
                          HasSubstr("my.bag: topic /points: 2 messages are skipped, the first "
                                    "because it is a PointCloud2 of 20 bytes"),
                          "the bag is cut"));
}

TEST(RosCloudReader, GivesOnlyTheCloudsThatAreSelected) {
  RosCloudReader livox(MakeBag(), "my.bag");
  livox.Select({2});
  EXPECT_THAT(ReadTopics(&livox), ElementsAre(2, 2));
  RosCloudReader none(MakeBag(), "my.bag");
  none.Select({0});
  EXPECT_THAT(ReadTopics(&none), ElementsAre());
}

}  // namespace
}  // namespace trajlo
