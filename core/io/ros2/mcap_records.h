// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace trajlo {

/// The records of the MCAP format (https://mcap.dev/spec) that matter for messages. Every
/// record is one byte of opcode, eight of length, and its content. Parsers return nothing when a
/// content is shorter than its fields.
enum class McapOpcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F
};

constexpr std::string_view kMcapMagic("\x89MCAP0\r\n", 8);
/// Opcode and length.
constexpr std::uint64_t kMcapPrefixBytes = 9;

/// A record within bytes in memory.
struct McapRecord {
  McapOpcode opcode{};
  std::string_view content;
};

/// Takes the record at the front of `bytes`; nothing if it is not whole.
std::optional<McapRecord> TakeMcapRecord(std::string_view* bytes);

struct McapSchema {
  std::uint16_t id = 0;
  /// "sensor_msgs/msg/PointCloud2"
  std::string name;
  /// "ros2msg", "ros1msg", "ros2idl", "protobuf", ... and the text of the interface in it.
  std::string language;
  std::string text;
};
std::optional<McapSchema> ParseMcapSchema(std::string_view content);

struct McapChannel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;
  std::string topic;
  /// "cdr", "ros1", ...
  std::string encoding;
  /// What rosbag2 notes of the qualities of service.
  std::string qos;
};
std::optional<McapChannel> ParseMcapChannel(std::string_view content);

struct McapMessage {
  std::uint16_t channel_id = 0;
  std::int64_t log_time_ns = 0;
  std::string_view data;
};
std::optional<McapMessage> ParseMcapMessage(std::string_view content);

struct McapChunk {
  /// Of the records, once they are unpacked.
  std::uint64_t unpacked_size = 0;
  /// 0: unknown.
  std::uint32_t crc = 0;
  /// "", "zstd" or "lz4".
  std::string compression;
  std::uint64_t packed_size = 0;
  /// Where the records begin within the content.
  std::size_t records_offset = 0;
};
/// The content may be cut behind the records' beginning.
std::optional<McapChunk> ParseMcapChunk(std::string_view content);

struct McapFooter {
  /// Where the summary begins in the file; 0: there is none.
  std::uint64_t summary_start = 0;
  /// Over the summary and the footer up to here; 0: unknown.
  std::uint32_t summary_crc = 0;
};
std::optional<McapFooter> ParseMcapFooter(std::string_view content);

/// Where a chunk's record begins in the file.
std::optional<std::uint64_t> ParseMcapChunkIndex(std::string_view content);

/// How many messages each channel has.
std::optional<std::unordered_map<std::uint16_t, std::uint64_t>> ParseMcapStatistics(
    std::string_view content);

}  // namespace trajlo
