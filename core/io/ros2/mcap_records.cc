// SPDX-License-Identifier: MIT
#include "core/io/ros2/mcap_records.h"

#include "core/io/messages/wire_reader.h"

namespace trajlo {
namespace {

WireReader ReaderOf(std::string_view content) { return {content, Encoding::kRos1}; }

}  // namespace

std::optional<McapRecord> TakeMcapRecord(std::string_view* bytes) {
  WireReader reader = ReaderOf(*bytes);
  McapRecord record;
  record.opcode = static_cast<McapOpcode>(reader.Read<std::uint8_t>());
  record.content = reader.ReadBytes(reader.Read<std::uint64_t>());
  if (!reader.ok()) return {};
  bytes->remove_prefix(reader.position());
  return record;
}

std::optional<McapSchema> ParseMcapSchema(std::string_view content) {
  WireReader reader = ReaderOf(content);
  McapSchema schema;
  schema.id = reader.Read<std::uint16_t>();
  schema.name = reader.ReadString();
  if (!reader.ok()) return {};
  // Without them messages can be read all the same.
  schema.language = reader.ReadString();
  schema.text = reader.ReadString();
  return schema;
}

std::optional<McapChannel> ParseMcapChannel(std::string_view content) {
  WireReader reader = ReaderOf(content);
  McapChannel channel;
  channel.id = reader.Read<std::uint16_t>();
  channel.schema_id = reader.Read<std::uint16_t>();
  channel.topic = reader.ReadString();
  channel.encoding = reader.ReadString();
  if (!reader.ok()) return {};
  WireReader metadata = ReaderOf(reader.ReadString());
  while (metadata.remaining() > 0) {
    const std::string_view key = metadata.ReadString(), value = metadata.ReadString();
    if (key == "offered_qos_profiles") channel.qos = value;
  }
  return channel;
}

std::optional<McapMessage> ParseMcapMessage(std::string_view content) {
  WireReader reader = ReaderOf(content);
  McapMessage message;
  message.channel_id = reader.Read<std::uint16_t>();
  reader.Read<std::uint32_t>();  // sequence
  message.log_time_ns = static_cast<std::int64_t>(reader.Read<std::uint64_t>());
  reader.Read<std::uint64_t>();  // publish_time
  if (!reader.ok()) return {};
  message.data = reader.ReadBytes(reader.remaining());
  return message;
}

std::optional<McapChunk> ParseMcapChunk(std::string_view content) {
  WireReader reader = ReaderOf(content);
  McapChunk chunk;
  reader.Read<std::uint64_t>();  // message_start_time
  reader.Read<std::uint64_t>();  // message_end_time
  chunk.unpacked_size = reader.Read<std::uint64_t>();
  chunk.crc = reader.Read<std::uint32_t>();
  chunk.compression = reader.ReadString();
  chunk.packed_size = reader.Read<std::uint64_t>();
  chunk.records_offset = reader.position();
  if (!reader.ok()) return {};
  return chunk;
}

std::optional<McapFooter> ParseMcapFooter(std::string_view content) {
  WireReader reader = ReaderOf(content);
  McapFooter footer;
  footer.summary_start = reader.Read<std::uint64_t>();
  reader.Read<std::uint64_t>();  // summary_offset_start
  footer.summary_crc = reader.Read<std::uint32_t>();
  if (!reader.ok()) return {};
  return footer;
}

std::optional<std::uint64_t> ParseMcapChunkIndex(std::string_view content) {
  WireReader reader = ReaderOf(content);
  reader.Read<std::uint64_t>();  // message_start_time
  reader.Read<std::uint64_t>();  // message_end_time
  const auto chunk_start = reader.Read<std::uint64_t>();
  if (!reader.ok()) return {};
  return chunk_start;
}

std::optional<std::unordered_map<std::uint16_t, std::uint64_t>> ParseMcapStatistics(
    std::string_view content) {
  WireReader reader = ReaderOf(content);
  // message_count, then the numbers of schemas, channels, attachments, metadata and chunks, then
  // the first and the last time.
  reader.ReadBytes(8 + 2 + 4 + 4 + 4 + 4 + 8 + 8);
  WireReader entries = ReaderOf(reader.ReadString());
  if (!reader.ok()) return {};
  std::unordered_map<std::uint16_t, std::uint64_t> counts;
  while (entries.remaining() > 0) {
    const auto channel = entries.Read<std::uint16_t>();
    const auto count = entries.Read<std::uint64_t>();
    if (!entries.ok()) return {};
    counts[channel] = count;
  }
  return counts;
}

}  // namespace trajlo
