// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/messages/raw_message.h"
#include "core/io/random_access_file.h"
#include "core/io/ros2/mcap_records.h"

namespace trajlo {

/// Walks once through the data section of an MCAP file, from its beginning to its end, and yields
/// the schemas, channels and messages, those within chunks included. Memory holds one chunk.
///
/// A chunk is believed if it has the size and the checksum that it declares, else skipped; of the
/// last chunk of a file that was cut off, the whole records come. Behind a broken length reading
/// goes on at the next of `chunk_offsets`, or ends.
class McapStream {
 public:
  /// What is lost is added to `report`, in sentences that begin with `path`. `chunk_offsets`,
  /// sorted, may be empty.
  McapStream(std::shared_ptr<const RandomAccessFile> file, std::filesystem::path path,
             std::vector<std::uint64_t> chunk_offsets, MessageReport* report);

  /// The next Schema, Channel or Message, valid until the next call; false at the end.
  bool Next(McapRecord* record);

 private:
  enum class Outcome { kNothing, kRecord, kEnd };

  bool NextInChunk(McapRecord* record);
  Outcome NextInFile(McapRecord* record);
  void OpenChunk(std::uint64_t offset, FileBytes content, bool is_cut);
  /// The end of a file that has no end mark, or a broken length at `at_`.
  Outcome HandleCut(McapOpcode opcode);
  void Lose(std::uint64_t offset, std::uint64_t bytes, const std::string& what);

  std::shared_ptr<const RandomAccessFile> file_;
  std::filesystem::path path_;
  std::vector<std::uint64_t> chunk_offsets_;
  /// Where the next record begins in the file.
  std::uint64_t at_;
  /// The content of a record of the file, or the unpacked records of a chunk.
  FileBytes buffer_;
  /// What is still to be read of the chunk in `buffer_`, which begins at `chunk_offset_`.
  std::string_view in_chunk_;
  std::uint64_t chunk_offset_ = 0;
  bool chunk_is_cut_ = false;
  bool ended_ = false;
  MessageReport* report_;
};

}  // namespace trajlo
