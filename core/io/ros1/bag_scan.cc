// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "core/io/ros1/bag_chunk.h"
#include "core/io/ros1/bag_index.h"

namespace trajlo::ros1 {
namespace {

using Counts = std::map<std::uint32_t, std::uint64_t>;

class Scanner {
 public:
  Scanner(const RandomAccessFile& file, DamageLog* log) : file_(file), log_(log), reader_(file) {}

  BagIndex Scan() {
    std::uint64_t offset = kMagic.size();
    while (offset < file_.size()) {
      const auto record = ReadRecord(file_, offset);
      if (record && record->op == Op::kChunk) {
        FinishChunk(true);
        offset = StartChunk(offset, *record);
      } else if (record && record->end() <= file_.size()) {
        AddRecord(*record);
        offset = record->end();
      } else {
        FinishChunk(false);
        const std::uint64_t next = FindChunk(file_, offset + 1);
        log_->Add(offset, "records are cut or broken", next - offset);
        offset = next;
      }
    }
    FinishChunk(false);
    return std::move(index_);
  }

 private:
  /// Returns where it ends.
  std::uint64_t StartChunk(std::uint64_t offset, const FileRecord& record) {
    // A whole chunk is followed by a record: a broken length hardly leads to one.
    const bool complete = record.data_size > 0 && record.end() <= file_.size() &&
                          (record.end() == file_.size() || ReadRecord(file_, record.end()));
    chunk_.emplace();
    chunk_->offset = offset;
    chunk_->limit = complete ? record.end() : FindChunk(file_, record.data_offset);
    counts_.clear();
    return chunk_->limit;
  }

  void AddRecord(const FileRecord& record) {
    if (record.op == Op::kIndexData) {
      if (chunk_) AddIndexOfChunk(record);
      return;
    }
    FinishChunk(true);
    if (record.op != Op::kConnection) return;
    const auto data = ReadData(file_, record);
    const auto connection = data ? ParseConnection(record.fields(), *data) : std::nullopt;
    if (connection) index_.AddConnection(*connection);
  }

  /// Stamps and places of the messages of one connection in the chunk in front of the record.
  void AddIndexOfChunk(const FileRecord& record) {
    constexpr std::size_t kStampAndPlace = 12;
    const auto connection = record.fields().Number<std::uint32_t>("conn");
    const auto data = ReadData(file_, record);
    if (!connection || !data || data->size() < kStampAndPlace) return;
    for (std::size_t at = 0; at + kStampAndPlace <= data->size(); at += kStampAndPlace) {
      std::uint64_t stamp = 0;
      std::memcpy(&stamp, data->data() + at, sizeof(stamp));
      Count(*connection, TimeNs(stamp));
    }
  }

  void Count(std::uint32_t connection, std::int64_t recorded_ns) {
    chunk_->start_ns = counts_.empty() ? recorded_ns : std::min(chunk_->start_ns, recorded_ns);
    ++counts_[connection];
  }

  /// `index_is_whole`: the index of the chunk, if there is one, has been seen to its end. It saves
  /// decompressing the chunk here, unless that is the one that defines a topic.
  void FinishChunk(bool index_is_whole) {
    if (!chunk_) return;
    const bool known = std::all_of(counts_.begin(), counts_.end(), [&](const auto& count) {
      return index_.topic_of_connection.count(count.first) > 0;
    });
    if (!index_is_whole || counts_.empty() || !known) {
      counts_.clear();
      reader_.Read(chunk_->offset, chunk_->limit, &read_);
      for (const Connection& connection : read_.connections) index_.AddConnection(connection);
      for (const MessagePlace& message : read_.messages) {
        Count(message.connection, message.recorded_ns);
      }
      if (!read_.damage.empty()) {
        log_->Add(chunk_->offset, read_.damage, read_.bytes_lost);
        chunk_->damage_logged = true;
      }
    }
    if (!counts_.empty()) index_.AddChunk(std::move(*chunk_), counts_);
    chunk_.reset();
  }

  const RandomAccessFile& file_;
  DamageLog* log_;
  ChunkReader reader_;
  Chunk read_;
  BagIndex index_;
  /// The chunk whose index may follow, and what is known of its messages.
  std::optional<ChunkEntry> chunk_;
  Counts counts_;
};

}  // namespace

BagIndex ScanBag(const RandomAccessFile& file, DamageLog* log) { return Scanner(file, log).Scan(); }

}  // namespace trajlo::ros1
