// SPDX-License-Identifier: MIT
#include "core/io/recording/chained_clouds.h"

#include <algorithm>
#include <utility>

namespace trajlo {

ChainedClouds::ChainedClouds(std::vector<std::unique_ptr<CloudMessageReader>> parts) {
  for (auto& reader : parts) {
    Part part{std::move(reader), {}, {}};
    part.merger.Take(part.reader->report(), &report_);
    for (std::size_t i = 0; i < part.reader->topics().size(); ++i) {
      const Topic& topic = part.reader->topics()[i];
      const auto known = std::find_if(topics_.begin(), topics_.end(), [&](const Topic& other) {
        return other.name == topic.name && other.type == topic.type;
      });
      part.common_topic.push_back(static_cast<std::size_t>(known - topics_.begin()));
      if (known == topics_.end()) {
        topics_.push_back(topic);
        is_cloud_.push_back(part.reader->IsCloud(i));
      } else {
        known->messages += topic.messages;
      }
    }
    parts_.push_back(std::move(part));
  }
}

void ChainedClouds::Select(const std::vector<std::size_t>& topics) {
  for (Part& part : parts_) {
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < part.common_topic.size(); ++i) {
      const bool wanted =
          std::find(topics.begin(), topics.end(), part.common_topic[i]) != topics.end();
      if (wanted) own.push_back(i);
    }
    part.reader->Select(own);
  }
}

bool ChainedClouds::Next(CloudMessage* message) {
  for (; current_ < parts_.size(); parts_[current_++].reader.reset()) {
    Part& part = parts_[current_];
    const bool is_read = part.reader->Next(message);
    // At once: reading may stop within a part.
    part.merger.Take(part.reader->report(), &report_);
    if (!is_read) continue;
    message->topic = part.common_topic[message->topic];
    return true;
  }
  return false;
}

}  // namespace trajlo
