// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/io/atomic_file.h"
#include "core/io/messages/bag_writer.h"
#include "core/io/ros1/bag_record.h"
#include "core/io/ros1/chunk_codec.h"

namespace trajlo {

struct Ros1BagOptions {
  BagCompression compression = BagCompression::kNone;
  /// A chunk is written when it has become larger than this.
  std::size_t chunk_bytes = 768 * 1024;
  IfExists if_exists = IfExists::kFail;
};

/// Writes a ROS 1 bag (format 2.0), as `<name>.part` until Close().
///
/// Not through librosbag: when the disk is full its destructor throws, which ends the process.
class Ros1BagWriter : public BagWriter {
 public:
  explicit Ros1BagWriter(const std::filesystem::path& path, const Ros1BagOptions& options = {});

  Encoding encoding() const override { return Encoding::kRos1; }
  /// `message` has 512 MB at most. `recorded_ns` is from 0 to the
  /// year 2106, as the format demands, and need not increase.
  void Write(const TopicDescription& topic, std::int64_t recorded_ns,
             std::string_view message) override;
  /// The same for a message of another bag, whose publisher keeps all that is known of it but its
  /// id. Publishers that differ in nothing else become one.
  void Write(const ros1::Connection& publisher, std::int64_t recorded_ns, std::string_view message);
  void Close() override;

 private:
  /// `header` as that of ros1::Connection.
  void Write(const std::string& topic, const std::string& header, std::int64_t recorded_ns,
             std::string_view message);
  std::uint32_t ConnectionOf(const std::string& topic, const std::string& header);
  void FinishChunk();
  void Append(std::string_view bytes);
  std::string FileHeader(std::uint64_t index_pos) const;

  std::filesystem::path path_;
  Ros1BagOptions options_;
  std::optional<AtomicFile> file_;
  std::uint64_t file_bytes_ = 0;
  /// By topic and header.
  std::map<std::pair<std::string, std::string>, std::uint32_t> connections_;
  /// What the index at the end will consist of.
  std::string connection_records_;
  std::string chunk_records_;
  std::uint32_t chunk_count_ = 0;

  /// The chunk that is being filled: its records, its stamps and offsets by connection.
  std::string chunk_;
  std::map<std::uint32_t, std::string> chunk_index_;
  std::int64_t chunk_start_ns_ = 0;
  std::int64_t chunk_end_ns_ = 0;
};

}  // namespace trajlo
