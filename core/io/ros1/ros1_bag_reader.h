// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <queue>
#include <utility>
#include <vector>

#include "core/io/messages/raw_message.h"
#include "core/io/random_access_file.h"
#include "core/io/ros1/bag_chunk.h"
#include "core/io/ros1/bag_index.h"
#include "core/io/ros1/chunks_ahead.h"
#include "core/io/ros1/damage_log.h"

namespace trajlo {

/// A ROS 1 bag (format 2.0, chunks plain, bz2 or lz4, of any size). Messages come in the order in
/// which they were recorded, also where chunks overlap.
///
/// A bag that is cut, was never closed (`.active`) or has a broken index is scanned from front to
/// back when it is opened, which takes as long as reading the file; then all messages come that are
/// whole. Of a cut chunk those in front of the cut come, as far as its compression allows (whole
/// blocks). Such a bag counts as damaged even if no byte is lost: what the recorder had not yet
/// written is missing. Where single chunks are broken, reading goes on behind them.
///
/// Not through librosbag: it crashes on broken bags (nothing it reads is checked against the bounds
/// of a chunk), cannot read lz4 chunks of linked blocks as other writers make them, and
/// decompresses overlapping chunks again for every message.
///
/// Memory holds one decompressed chunk, or up to 64 MB of them where chunks overlap in time, and
/// what is decompressed ahead (see ChunksAhead).
class Ros1BagReader : public RawMessageReader {
 public:
  /// That many `threads` (0: one for each core) decompress the bz2 chunks that come next, unless it
  /// is 1; messages and report do not depend on it. Throws InputError: no such file, not a bag,
  /// encrypted, or damaged without a message left.
  explicit Ros1BagReader(const std::filesystem::path& path, int threads = 1);

  const std::vector<Topic>& topics() const override { return index_.topics; }
  void Select(const std::vector<std::size_t>& topics) override;
  bool Next(RawMessage* message) override;
  const MessageReport& report() const override { return log_.report(); }

  /// Who published the message that `Next` gave last.
  const ros1::Connection& connection() const { return index_.connections.at(connection_); }

 private:
  /// A chunk of which messages are still to come.
  struct OpenChunk {
    /// Empty while other chunks need the memory more.
    ros1::ByteBuffer bytes;
    /// In the order of recording.
    std::vector<ros1::MessagePlace> messages;
    std::size_t next = 0;
  };
  using OpenChunks = std::map<std::size_t, OpenChunk>;

  bool IsSelected(std::uint32_t connection) const;
  bool IsWanted(std::size_t chunk) const;
  void StartAhead();
  void Open(std::size_t chunk);
  void Load(OpenChunks::value_type* open);
  void MakeRoom(std::size_t chunk);
  bool Take(OpenChunks::value_type* open, RawMessage* message);

  RandomAccessFile file_;
  ros1::DamageLog log_;
  ros1::BagIndex index_;
  /// By topic.
  std::vector<bool> selected_;
  /// Of the last message.
  std::uint32_t connection_ = 0;
  ros1::ChunkReader reader_;
  /// The chunk that was read last; the memory of chunks that are done with returns here.
  ros1::Chunk read_;

  /// The first of index_.chunks that was not opened yet, and the first that was not started ahead.
  std::size_t next_chunk_ = 0;
  std::size_t next_ahead_ = 0;
  OpenChunks open_;
  /// When the next message of each open chunk was recorded.
  using Head = std::pair<std::int64_t, std::size_t>;
  std::priority_queue<Head, std::vector<Head>, std::greater<>> heads_;
  std::size_t held_bytes_ = 0;
  /// Declared last: it stops before the file is closed.
  ros1::ChunksAhead ahead_;
};

}  // namespace trajlo
