// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/io/messages/raw_message.h"
#include "core/io/random_access_file.h"
#include "core/io/ros1/bag_record.h"
#include "core/io/ros1/damage_log.h"

namespace trajlo::ros1 {

struct ChunkEntry {
  /// Where its record begins, and where it certainly ends.
  std::uint64_t offset = 0;
  std::uint64_t limit = 0;
  /// When its first message was recorded.
  std::int64_t start_ns = 0;
  /// Those that have messages in it.
  std::vector<std::uint32_t> connections;
  /// Its damage is in the log already.
  bool damage_logged = false;
};

/// What a bag holds and where, from its index or from a scan.
struct BagIndex {
  std::vector<Topic> topics;
  /// By their ids.
  std::map<std::uint32_t, Connection> connections;
  std::unordered_map<std::uint32_t, std::size_t> topic_of_connection;
  /// In the order of start_ns.
  std::vector<ChunkEntry> chunks;
  /// Of connections that were not known when the chunk was added: the one that defines them may be
  /// broken, and the index at the end has them, too.
  std::map<std::uint32_t, std::uint64_t> messages_of_unknown;

  void AddConnection(const Connection& connection);
  void AddChunk(ChunkEntry chunk, const std::map<std::uint32_t, std::uint64_t>& counts);
};

/// Takes the index at the end of the bag if it is whole. Otherwise reads the bag from front to
/// back, and says so in `log`. Throws InputError when this is no bag (format 2.0, not encrypted),
/// or has no message that can be read although it is damaged.
BagIndex BuildIndex(const RandomAccessFile& file, DamageLog* log);

/// The parts of BuildIndex. ReadIndex returns false and says what is wrong in `why`.
bool ReadIndex(const RandomAccessFile& file, BagIndex* index, std::string* why);
BagIndex ScanBag(const RandomAccessFile& file, DamageLog* log);

}  // namespace trajlo::ros1
