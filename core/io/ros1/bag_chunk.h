// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/io/random_access_file.h"
#include "core/io/ros1/bag_record.h"
#include "core/io/ros1/byte_buffer.h"
#include "core/io/ros1/chunk_codec.h"

namespace trajlo::ros1 {

/// Where a message lies in the bytes of its chunk.
struct MessagePlace {
  std::int64_t recorded_ns = 0;
  std::uint32_t connection = 0;
  std::uint32_t offset = 0;
  std::uint32_t size = 0;
};

struct Chunk {
  /// Decompressed.
  ByteBuffer bytes;
  /// In the order of the file.
  std::vector<MessagePlace> messages;
  std::vector<Connection> connections;
  /// What is wrong; empty if nothing. Then `messages` are those in front of the damage.
  std::string damage;
  /// Behind the damage.
  std::uint64_t bytes_lost = 0;
};

class ChunkReader {
 public:
  /// `file` must outlive this.
  explicit ChunkReader(const RandomAccessFile& file) : file_(file) {}

  /// Reads the chunk whose record begins at `offset` and which ends before `limit`, where the next
  /// one begins. The length in its header is not relied upon: a recorder that crashed has left 0
  /// there. Reuses the memory of `chunk`.
  void Read(std::uint64_t offset, std::uint64_t limit, Chunk* chunk);

 private:
  const RandomAccessFile& file_;
  ByteBuffer stored_;
  Decompressor decompressor_;
};

}  // namespace trajlo::ros1
