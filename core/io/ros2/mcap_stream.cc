// SPDX-License-Identifier: MIT
#include "core/io/ros2/mcap_stream.h"

#include <zlib.h>

#include <algorithm>
#include <utility>

#include "core/io/format_text.h"
#include "core/io/messages/wire_reader.h"
#include "core/io/ros2/unpack.h"

namespace trajlo {
namespace {

/// A record that claims more is broken: writers close a chunk after a few megabytes.
constexpr std::uint64_t kLargestRecord = 1ULL << 30;

/// Of a file that is broken everywhere, the first places are enough.
constexpr std::size_t kMostWarnings = 20;

bool IsYielded(McapOpcode opcode) {
  return opcode == McapOpcode::kSchema || opcode == McapOpcode::kChannel ||
         opcode == McapOpcode::kMessage;
}

bool IsCrcRight(std::string_view bytes, std::uint32_t crc) {
  return crc == 0 ||
         crc == ::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
}

}  // namespace

McapStream::McapStream(std::shared_ptr<const RandomAccessFile> file, std::filesystem::path path,
                       std::vector<std::uint64_t> chunk_offsets, MessageReport* report)
    : file_(std::move(file)),
      path_(std::move(path)),
      chunk_offsets_(std::move(chunk_offsets)),
      at_(kMcapMagic.size()),
      report_(report) {}

bool McapStream::Next(McapRecord* record) {
  while (!ended_) {
    if (NextInChunk(record)) return true;
    const Outcome outcome = NextInFile(record);
    if (outcome == Outcome::kRecord) return true;
    ended_ = outcome == Outcome::kEnd;
  }
  return false;
}

bool McapStream::NextInChunk(McapRecord* record) {
  while (!in_chunk_.empty()) {
    const auto found = TakeMcapRecord(&in_chunk_);
    if (!found) {
      if (!chunk_is_cut_) {
        Lose(chunk_offset_, in_chunk_.size(), "the chunk ends within a record");
      }
      in_chunk_ = {};
      return false;
    }
    if (!IsYielded(found->opcode)) continue;
    *record = *found;
    return true;
  }
  return false;
}

McapStream::Outcome McapStream::NextInFile(McapRecord* record) {
  const FileBytes bytes = file_->Read(at_, kMcapPrefixBytes);
  if (bytes.size() < kMcapPrefixBytes) return HandleCut({});
  WireReader prefix(bytes.view(), Encoding::kRos1);
  const auto opcode = static_cast<McapOpcode>(prefix.Read<std::uint8_t>());
  const auto length = prefix.Read<std::uint64_t>();
  if (opcode == McapOpcode::kFooter || opcode == McapOpcode::kDataEnd) return Outcome::kEnd;
  if (length > file_->size() - at_ - kMcapPrefixBytes) return HandleCut(opcode);
  const std::uint64_t record_offset = at_;
  at_ += kMcapPrefixBytes + length;
  if (!IsYielded(opcode) && opcode != McapOpcode::kChunk) return Outcome::kNothing;
  if (length > kLargestRecord) {
    Lose(record_offset, length, "a record of this size is skipped");
    return Outcome::kNothing;
  }
  FileBytes content =
      file_->Read(record_offset + kMcapPrefixBytes, static_cast<std::size_t>(length));
  if (content.size() < length) {
    Lose(record_offset, length, "reading failed");
    return Outcome::kNothing;
  }
  if (opcode == McapOpcode::kChunk) {
    OpenChunk(record_offset, std::move(content), false);
    return Outcome::kNothing;
  }
  buffer_ = std::move(content);
  *record = {opcode, buffer_.view()};
  return Outcome::kRecord;
}

void McapStream::OpenChunk(std::uint64_t offset, FileBytes content, bool is_cut) {
  const auto chunk = ParseMcapChunk(content.view());
  if (!chunk) return Lose(offset, content.size(), "the chunk's header is cut");
  const std::string_view behind = content.view().substr(chunk->records_offset);
  if (!is_cut && chunk->packed_size > behind.size()) {
    return Lose(offset, content.size(), "the chunk's records do not fit into it");
  }
  const std::string_view packed = behind.substr(
      0, static_cast<std::size_t>(std::min<std::uint64_t>(chunk->packed_size, behind.size())));
  std::string problem;
  std::string_view records = packed;
  FileBytes owner;
  if (chunk->compression.empty()) {
    owner = std::move(content);
  } else if (chunk->compression == "zstd" || chunk->compression == "lz4") {
    const Codec codec = chunk->compression == "zstd" ? Codec::kZstd : Codec::kLz4Frame;
    Unpacked unpacked = Unpack(codec, packed, chunk->unpacked_size);
    owner = std::move(unpacked.bytes);
    records = owner.view();
    problem = std::move(unpacked.problem);
  } else {
    return Lose(offset, packed.size(), "the compression '" + chunk->compression + "' is unknown");
  }
  if (is_cut) {
    Lose(offset, file_->size() - offset,
         "the file ends within this chunk, whose beginning is read");
  } else if (!problem.empty()) {
    return Lose(offset, packed.size(), "the chunk is skipped: " + problem);
  } else if (records.size() != chunk->unpacked_size || !IsCrcRight(records, chunk->crc)) {
    return Lose(offset, packed.size(), "the chunk is skipped: its size or checksum is wrong");
  }
  buffer_ = std::move(owner);
  in_chunk_ = records;
  chunk_offset_ = offset;
  chunk_is_cut_ = is_cut;
}

McapStream::Outcome McapStream::HandleCut(McapOpcode opcode) {
  const std::uint64_t offset = at_;
  const auto next = std::upper_bound(chunk_offsets_.begin(), chunk_offsets_.end(), offset);
  if (next != chunk_offsets_.end() && *next < file_->size()) {
    at_ = *next;
    Lose(offset, at_ - offset, "a record's length is broken; reading goes on at the next chunk");
    return Outcome::kNothing;
  }
  at_ = file_->size();
  if (opcode == McapOpcode::kChunk && at_ - offset < kLargestRecord) {
    OpenChunk(offset, file_->Read(offset + kMcapPrefixBytes, at_ - offset - kMcapPrefixBytes),
              true);
    return Outcome::kNothing;
  }
  if (!report_->damaged || offset < at_) {
    Lose(offset, at_ - offset, "the file ends without its end mark, as after a killed recorder");
  }
  return Outcome::kEnd;
}

void McapStream::Lose(std::uint64_t offset, std::uint64_t bytes, const std::string& what) {
  report_->damaged = true;
  report_->bytes_lost += bytes;
  if (report_->warnings.size() >= kMostWarnings) return;
  report_->warnings.push_back(path_.string() + ": byte " + std::to_string(offset) + ": " + what +
                              " (" + CountOf(bytes, "byte") + ")");
}

}  // namespace trajlo
