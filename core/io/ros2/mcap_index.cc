// SPDX-License-Identifier: MIT
#include "core/io/ros2/mcap_index.h"

#include <zlib.h>

#include <algorithm>
#include <optional>

#include "core/io/ros2/mcap_stream.h"
#include "core/io/ros2/topic_names.h"

namespace trajlo {
namespace {

constexpr std::uint64_t kFooterBytes = kMcapPrefixBytes + 8 + 8 + 4;
/// The checksum covers the footer up to itself.
constexpr std::uint64_t kCrcBytes = 4;
/// A summary has some hundred bytes a chunk.
constexpr std::uint64_t kLargestSummary = 1ULL << 28;

struct Summary {
  /// With the footer.
  FileBytes bytes;
  std::uint64_t start = 0;
};

std::optional<Summary> ReadSummary(const RandomAccessFile& file) {
  const std::uint64_t tail = kFooterBytes + kMcapMagic.size();
  if (file.size() < tail + kMcapMagic.size()) return {};
  const std::uint64_t footer_start = file.size() - tail;
  const FileBytes end = file.Read(footer_start, static_cast<std::size_t>(tail));
  std::string_view rest = end.view();
  const auto record = TakeMcapRecord(&rest);
  if (!record || record->opcode != McapOpcode::kFooter || rest != kMcapMagic) return {};
  const auto footer = ParseMcapFooter(record->content);
  if (!footer || footer->summary_start < kMcapMagic.size() ||
      footer->summary_start > footer_start ||
      footer_start - footer->summary_start > kLargestSummary) {
    return {};
  }
  Summary summary;
  summary.start = footer->summary_start;
  summary.bytes = file.Read(summary.start,
                            static_cast<std::size_t>(footer_start + kFooterBytes - summary.start));
  if (summary.bytes.size() != footer_start + kFooterBytes - summary.start) return {};
  const auto* begin = reinterpret_cast<const Bytef*>(summary.bytes.data());
  if (footer->summary_crc != 0 &&
      footer->summary_crc != ::crc32_z(0, begin, summary.bytes.size() - kCrcBytes)) {
    return {};
  }
  return summary;
}

std::optional<McapIndex> IndexFromSummary(const RandomAccessFile& file) {
  const auto summary = ReadSummary(file);
  if (!summary) return {};
  McapIndex index;
  bool counted = false;
  std::string_view rest = summary->bytes.view();
  while (const auto record = TakeMcapRecord(&rest)) {
    index.topics.Add(*record);
    if (record->opcode == McapOpcode::kChunkIndex) {
      const auto offset = ParseMcapChunkIndex(record->content);
      if (!offset) return {};
      if (*offset < summary->start) index.chunk_offsets.push_back(*offset);
    }
    if (record->opcode == McapOpcode::kStatistics) {
      const auto counts = ParseMcapStatistics(record->content);
      if (!counts) return {};
      for (const auto& [channel, n] : *counts) {
        const std::size_t* topic = index.topics.Find(channel);
        if (topic == nullptr) return {};
        index.topics.CountMessages(*topic, n);
      }
      counted = !counts->empty();
    }
  }
  if (!counted) return {};
  std::sort(index.chunk_offsets.begin(), index.chunk_offsets.end());
  return index;
}

}  // namespace

void McapTopics::Add(const McapRecord& record) {
  if (record.opcode == McapOpcode::kSchema) {
    const auto schema = ParseMcapSchema(record.content);
    if (schema) schemas_.emplace(schema->id, *schema);
    return;
  }
  if (record.opcode != McapOpcode::kChannel) return;
  const auto channel = ParseMcapChannel(record.content);
  if (!channel || topic_of_channel_.count(channel->id) > 0) return;
  const auto found = schemas_.find(channel->schema_id);
  McapSchema schema;
  if (found != schemas_.end()) schema = found->second;
  Topic topic = MakeTopic(channel->topic, found == schemas_.end() ? "unknown" : schema.name,
                          channel->encoding);
  SetInterface(schema.language, schema.text, channel->qos, &topic);
  const auto same = std::find_if(topics_.begin(), topics_.end(), [&](const Topic& other) {
    return other.name == topic.name && other.type == topic.type && other.encoding == topic.encoding;
  });
  topic_of_channel_[channel->id] = static_cast<std::size_t>(same - topics_.begin());
  if (same == topics_.end()) topics_.push_back(topic);
}

const std::size_t* McapTopics::Find(std::uint16_t channel) const {
  const auto found = topic_of_channel_.find(channel);
  return found == topic_of_channel_.end() ? nullptr : &found->second;
}

McapIndex ReadMcapIndex(const std::shared_ptr<const RandomAccessFile>& file,
                        const std::filesystem::path& path) {
  if (auto index = IndexFromSummary(*file)) return *std::move(index);
  McapIndex index;
  index.was_scanned = true;
  McapStream stream(file, path, {}, &index.scan);
  McapRecord record;
  while (stream.Next(&record)) {
    index.topics.Add(record);
    if (record.opcode != McapOpcode::kMessage) continue;
    const auto message = ParseMcapMessage(record.content);
    const std::size_t* topic = message ? index.topics.Find(message->channel_id) : nullptr;
    if (topic != nullptr) index.topics.CountMessages(*topic, 1);
  }
  return index;
}

}  // namespace trajlo
