// SPDX-License-Identifier: MIT
#include "core/io/ros1/bag_chunk.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace trajlo::ros1 {
namespace {

// The format counts the bytes of a chunk with a uint32.
constexpr std::uint64_t kMaxBytes = 0xffffffffU;

/// Finds the messages in `chunk->bytes`; returns how many bytes it understood.
std::size_t ListMessages(Chunk* chunk) {
  std::string_view rest = chunk->bytes.view();
  while (!rest.empty()) {
    std::string_view behind = rest;
    const auto record = TakeRecord(&behind);
    if (!record) break;
    if (record->op == Op::kConnection) {
      if (auto connection = ParseConnection(record->fields, record->data)) {
        chunk->connections.push_back(std::move(*connection));
      }
    } else if (record->op == Op::kMessage) {
      const auto id = record->fields.Number<std::uint32_t>("conn");
      const auto recorded_ns = record->fields.TimeNs("time");
      if (!id || !recorded_ns) break;
      chunk->messages.push_back(
          {*recorded_ns, *id, static_cast<std::uint32_t>(record->data.data() - chunk->bytes.data()),
           static_cast<std::uint32_t>(record->data.size())});
    } else {
      break;
    }
    rest = behind;
  }
  return chunk->bytes.size() - rest.size();
}

}  // namespace

void ChunkReader::Read(std::uint64_t offset, std::uint64_t limit, Chunk* chunk) {
  chunk->bytes.Resize(0);
  chunk->messages.clear();
  chunk->connections.clear();
  chunk->damage.clear();
  chunk->bytes_lost = 0;
  const auto record = ReadRecord(file_, offset);
  const auto compression = record && record->op == Op::kChunk && record->data_offset <= limit
                               ? FindCompression(record->fields().Find("compression").value_or(""))
                               : std::nullopt;
  if (!compression) {
    chunk->damage = "there is no readable chunk here";
    chunk->bytes_lost = limit - offset;
    return;
  }
  ByteBuffer& stored = *compression == BagCompression::kNone ? chunk->bytes : stored_;
  stored.Resize(std::min<std::uint64_t>(limit - record->data_offset, kMaxBytes));
  stored.Resize(file_.Read(record->data_offset, stored.data(), stored.size()));
  if (*compression == BagCompression::kNone) {
    const std::size_t understood = ListMessages(chunk);
    if (understood == record->data_size && understood > 0) return;
    const bool complete = record->data_size > 0 && record->data_size <= stored.size();
    const std::size_t size = complete ? record->data_size : stored.size();
    chunk->damage = complete ? "a record of this chunk is broken" : "this chunk is not complete";
    chunk->bytes_lost = size - std::min(size, understood);
    return;
  }
  const auto declared = record->fields().Number<std::uint32_t>("size").value_or(0);
  const Decompressor::Result result =
      decompressor_.Decompress(*compression, stored.view(), declared, &chunk->bytes);
  const std::size_t behind = chunk->bytes.size() - ListMessages(chunk);
  if (!result.damage.empty()) {
    chunk->damage = "this chunk is damaged: " + result.damage;
    chunk->bytes_lost = stored.size() - result.consumed;
  } else if (behind > 0) {
    chunk->damage = "a record of this chunk is broken";
  }
  chunk->bytes_lost += behind;
}

}  // namespace trajlo::ros1
