// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/io/messages/raw_message.h"
#include "core/io/random_access_file.h"
#include "core/io/ros2/mcap_records.h"

namespace trajlo {

/// The topics of an MCAP file. Channels of one topic, type and encoding (one for each publisher)
/// are one topic.
class McapTopics {
 public:
  /// Takes note of a Schema or Channel; of two with the same number, the first is valid.
  void Add(const McapRecord& record);
  /// Index into topics(), or nothing for a channel that was not announced.
  const std::size_t* Find(std::uint16_t channel) const;
  void CountMessages(std::size_t topic, std::uint64_t n) { topics_[topic].messages += n; }
  const std::vector<Topic>& topics() const { return topics_; }

 private:
  std::unordered_map<std::uint16_t, McapSchema> schemas_;
  std::unordered_map<std::uint16_t, std::size_t> topic_of_channel_;
  std::vector<Topic> topics_;
};

/// What an MCAP file holds.
struct McapIndex {
  McapTopics topics;
  /// Where chunks begin in the file, sorted; empty if the file has no summary.
  std::vector<std::uint64_t> chunk_offsets;
  /// Whether the whole file was read for this, and what is damaged in it then.
  bool was_scanned = false;
  MessageReport scan;
};

/// From the summary at the end of the file. Where there is none, or it is broken or does not count
/// the messages of every channel, by reading the whole file once.
McapIndex ReadMcapIndex(const std::shared_ptr<const RandomAccessFile>& file,
                        const std::filesystem::path& path);

}  // namespace trajlo
