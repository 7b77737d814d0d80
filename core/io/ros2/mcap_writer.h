// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/io/atomic_file.h"
#include "core/io/messages/bag_writer.h"
#include "core/io/ros2/mcap_records.h"
#include "core/io/ros2/unpack.h"

namespace trajlo {

struct McapOptions {
  /// Of chunks; nothing: none.
  std::optional<Codec> compression = Codec::kZstd;
  /// A chunk is written when it has become larger than this.
  std::size_t chunk_bytes = std::size_t{4} << 20U;
  IfExists if_exists = IfExists::kFail;
};

/// Writes an MCAP file (https://mcap.dev/spec) as ROS 2 does: chunks with checksums and indices,
/// and a summary with the interfaces, so that players can seek and decode without ROS.
class McapWriter : public BagWriter {
 public:
  explicit McapWriter(const std::filesystem::path& path, const McapOptions& options = {});

  Encoding encoding() const override { return Encoding::kCdr; }
  /// Times are not negative.
  void Write(const TopicDescription& topic, std::int64_t recorded_ns,
             std::string_view message) override;
  void Close() override;

 private:
  struct Channel {
    std::uint16_t id = 0;
    std::uint32_t messages = 0;
  };
  std::uint16_t SchemaOf(const MessageDescription& message);
  Channel& ChannelOf(const TopicDescription& topic);
  void FinishChunk();
  void WriteChunk(std::string_view stored);
  void AddChunkIndex(std::uint64_t chunk_offset, std::size_t stored_size);
  std::string StatisticsRecord() const;
  void WriteSummary();
  void Append(std::string_view bytes);

  std::filesystem::path path_;
  McapOptions options_;
  std::optional<AtomicFile> file_;
  std::uint64_t file_bytes_ = 0;
  std::map<std::string, std::uint16_t> schemas_;  ///< By type.
  std::map<std::string, Channel> channels_;       ///< By topic and type.

  /// What the summary will consist of.
  std::string schema_records_, channel_records_, chunk_records_;
  std::uint32_t chunk_count_ = 0;
  std::uint64_t message_count_ = 0;
  std::uint64_t start_ns_ = 0, end_ns_ = 0;

  /// The chunk that is being filled: its records, and by channel the times and offsets of messages.
  std::string chunk_;
  std::map<std::uint16_t, std::string> chunk_index_;
  std::uint64_t chunk_start_ns_ = 0, chunk_end_ns_ = 0;
};

}  // namespace trajlo
