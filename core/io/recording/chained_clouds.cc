// SPDX-License-Identifier: MIT
#include "core/io/recording/chained_clouds.h"

#include <algorithm>
#include <utility>

namespace trajlo {

ChainedClouds::ChainedClouds(std::vector<std::unique_ptr<CloudMessageReader>> parts) {
  for (auto& reader : parts) {
    Part part{std::move(reader), {}};
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
  for (; current_ < parts_.size(); FinishPart()) {
    Part& part = parts_[current_];
    if (!part.reader->Next(message)) continue;
    message->topic = part.common_topic[message->topic];
    return true;
  }
  return false;
}

/// Takes over what the part reports, and frees what it holds.
void ChainedClouds::FinishPart() {
  Part& part = parts_[current_++];
  const MessageReport& own = part.reader->report();
  report_.damaged = report_.damaged || own.damaged;
  report_.bytes_lost += own.bytes_lost;
  report_.warnings.insert(report_.warnings.end(), own.warnings.begin(), own.warnings.end());
  part.reader.reset();
}

}  // namespace trajlo
