// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/io/messages/cloud_message.h"

namespace trajlo::testing {

constexpr std::int64_t kMs = 1'000'000;

/// A message of one topic: ten points on the x axis, whose times run evenly over a sweep of 100 ms.
struct FakeMessage {
  std::size_t topic;
  std::int64_t stamp_ns;
  std::int64_t recorded_ns;
  /// Name of the first coordinate; something else makes the message unreadable.
  std::string x = "x";
  bool is_empty = false;
  std::string frame_id = "lidar";
};

inline PointTable TenPoints(const std::string& x) {
  struct Row {
    float x, y, z;
    std::uint32_t t;
  };
  std::vector<Row> rows;
  for (std::uint32_t i = 0; i < 10; ++i) {
    rows.push_back({1.0F + static_cast<float>(i), 0.0F, 0.0F, i * 10'000'000u});
  }
  PointTable table;
  table.bytes = FileBytes(rows.size() * sizeof(Row));
  std::memcpy(table.bytes.data(), rows.data(), table.bytes.size());
  table.columns = {{x, ScalarType::kFloat32, 0, sizeof(Row)},
                   {"y", ScalarType::kFloat32, 4, sizeof(Row)},
                   {"z", ScalarType::kFloat32, 8, sizeof(Row)},
                   {"t", ScalarType::kUint32, 12, sizeof(Row)}};
  table.count = rows.size();
  return table;
}

/// A recording in memory. Topics whose name begins with /cloud are clouds.
class FakeClouds final : public CloudMessageReader {
 public:
  FakeClouds(const std::vector<std::string>& names, std::vector<FakeMessage> messages,
             MessageReport at_end = {})
      : messages_(std::move(messages)), at_end_(std::move(at_end)) {
    for (const std::string& name : names) topics_.push_back({name, "sensor_msgs/PointCloud2"});
    for (const FakeMessage& message : messages_) ++topics_[message.topic].messages;
    for (std::size_t i = 0; i < topics_.size(); ++i) {
      if (IsCloud(i)) selected_.push_back(i);
    }
  }

  const std::vector<Topic>& topics() const override { return topics_; }
  bool IsCloud(std::size_t topic) const override {
    return topics_[topic].name.rfind("/cloud", 0) == 0;
  }
  void Select(const std::vector<std::size_t>& topics) override { selected_ = topics; }
  bool Next(CloudMessage* message) override {
    for (; next_ < messages_.size(); ++next_) {
      const FakeMessage& fake = messages_[next_];
      if (std::find(selected_.begin(), selected_.end(), fake.topic) == selected_.end()) continue;
      message->topic = fake.topic;
      message->stamp_ns = fake.stamp_ns;
      message->recorded_ns = fake.recorded_ns;
      message->frame_id = fake.frame_id;
      message->table = TenPoints(fake.x);
      if (fake.is_empty) message->table.count = 0;
      ++next_;
      return true;
    }
    report_ = at_end_;
    return false;
  }
  const MessageReport& report() const override { return report_; }

 private:
  std::vector<Topic> topics_;
  std::vector<FakeMessage> messages_;
  MessageReport report_, at_end_;
  std::vector<std::size_t> selected_;
  std::size_t next_ = 0;
};

/// Messages of topic 0 every 100 ms from 1000 s on, recorded `delay_ns` after their stamp.
inline std::vector<FakeMessage> RegularMessages(int count, std::int64_t delay_ns) {
  std::vector<FakeMessage> messages;
  for (int i = 0; i < count; ++i) {
    const std::int64_t stamp_ns = 1'000'000 * kMs + i * 100 * kMs;
    messages.push_back({0, stamp_ns, stamp_ns + delay_ns});
  }
  return messages;
}

}  // namespace trajlo::testing
