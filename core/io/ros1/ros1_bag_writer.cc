// SPDX-License-Identifier: MIT
#include "core/io/ros1/ros1_bag_writer.h"

#include <algorithm>
#include <cstring>
#include <fstream>

#include "core/io/errors.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

using ros1::Op;

// Of a message and of what stands before it in its chunk: a chunk stays below the 1 GiB that our
// reader accepts.
constexpr std::size_t kMaxBytes = (std::size_t{1} << 29U) - 4096;

template <typename T>
std::string Bytes(T number) {
  std::string bytes(sizeof(number), '\0');
  std::memcpy(bytes.data(), &number, sizeof(number));
  return bytes;
}

std::string StampBytes(std::int64_t t_ns) {
  return Bytes(static_cast<std::uint32_t>(t_ns / kNsPerSecond)) +
         Bytes(static_cast<std::uint32_t>(t_ns % kNsPerSecond));
}

std::string Block(std::string_view bytes) {
  return Bytes(static_cast<std::uint32_t>(bytes.size())).append(bytes);
}

std::string Field(const std::string& name, std::string_view value) {
  return Block((name + "=").append(value));
}

std::string Header(Op op, std::string_view fields) {
  return Block(Field("op", Bytes(op)).append(fields));
}

std::string ConnectionRecord(std::uint32_t id, const std::string& topic,
                             const std::string& header) {
  return Header(Op::kConnection, Field("conn", Bytes(id)) + Field("topic", topic)) + Block(header);
}

/// Overwrites the begin of a file that is complete otherwise.
void Overwrite(const std::filesystem::path& path, std::uint64_t offset, std::string_view bytes) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(static_cast<std::streamoff>(offset));
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw OutputError(path, "writing the bag's header failed");
}

}  // namespace

Ros1BagWriter::Ros1BagWriter(const std::filesystem::path& path, const Ros1BagOptions& options)
    : path_(path), options_(options) {
  file_.emplace(path, options.if_exists);
  Append(std::string(ros1::kMagic) + FileHeader(0));
}

void Ros1BagWriter::Write(const TopicDescription& topic, std::int64_t recorded_ns,
                          std::string_view message) {
  Write(topic.name,
        Field("topic", topic.name) + Field("type", topic.message.type) +
            Field("md5sum", topic.message.md5sum) +
            Field("message_definition", topic.message.definition) +
            (topic.is_latched ? Field("latching", "1") : ""),
        recorded_ns, message);
}

void Ros1BagWriter::Write(const ros1::Connection& publisher, std::int64_t recorded_ns,
                          std::string_view message) {
  Write(publisher.topic, publisher.header, recorded_ns, message);
}

void Ros1BagWriter::Write(const std::string& topic, const std::string& header,
                          std::int64_t recorded_ns, std::string_view message) {
  if (!file_) throw OutputError(path_, "writing after Close");
  constexpr std::int64_t kEndOfTime_ns = (std::int64_t{1} << 32U) * kNsPerSecond;
  if (recorded_ns < 0 || recorded_ns >= kEndOfTime_ns) {
    throw OutputError(path_, "a bag cannot hold the stamp " + std::to_string(recorded_ns) + " ns");
  }
  if (message.size() > kMaxBytes) {
    throw OutputError(path_,
                      "a message of " + std::to_string(message.size()) + " bytes is too long");
  }
  const std::uint32_t connection = ConnectionOf(topic, header);
  const bool first = chunk_index_.empty();
  chunk_start_ns_ = first ? recorded_ns : std::min(chunk_start_ns_, recorded_ns);
  chunk_end_ns_ = first ? recorded_ns : std::max(chunk_end_ns_, recorded_ns);
  chunk_index_[connection] +=
      StampBytes(recorded_ns) + Bytes(static_cast<std::uint32_t>(chunk_.size()));
  chunk_ += Header(Op::kMessage,
                   Field("conn", Bytes(connection)) + Field("time", StampBytes(recorded_ns)));
  chunk_ += Bytes(static_cast<std::uint32_t>(message.size()));
  chunk_ += message;
  if (chunk_.size() > std::min(options_.chunk_bytes, kMaxBytes)) FinishChunk();
}

void Ros1BagWriter::Close() {
  if (!file_) return;
  FinishChunk();
  const std::uint64_t index_pos = file_bytes_;
  Append(connection_records_);
  Append(chunk_records_);
  // A device has no part file, and nothing to overwrite.
  const std::filesystem::path part = path_.string() + ".part";
  if (std::filesystem::exists(part)) Overwrite(part, ros1::kMagic.size(), FileHeader(index_pos));
  file_->Commit();
  file_.reset();
}

std::uint32_t Ros1BagWriter::ConnectionOf(const std::string& topic, const std::string& header) {
  const auto id = static_cast<std::uint32_t>(connections_.size());
  const auto [place, is_new] = connections_.try_emplace({topic, header}, id);
  if (is_new) {
    const std::string record = ConnectionRecord(id, topic, header);
    connection_records_ += record;
    chunk_ += record;
  }
  return place->second;
}

void Ros1BagWriter::FinishChunk() {
  if (chunk_index_.empty()) return;
  const std::uint64_t offset = file_bytes_;
  const auto size = static_cast<std::uint32_t>(chunk_.size());
  Append(Header(Op::kChunk, Field("compression", ros1::CompressionName(options_.compression)) +
                                Field("size", Bytes(size))));
  Append(Block(ros1::Compress(options_.compression, chunk_)));
  std::string counts;
  for (const auto& [connection, index] : chunk_index_) {
    const auto count = static_cast<std::uint32_t>(index.size() / 12);
    Append(Header(Op::kIndexData, Field("ver", Bytes(std::uint32_t{1})) +
                                      Field("conn", Bytes(connection)) +
                                      Field("count", Bytes(count))) +
           Block(index));
    counts += Bytes(connection) + Bytes(count);
  }
  const auto connection_count = static_cast<std::uint32_t>(chunk_index_.size());
  chunk_records_ += Header(Op::kChunkInfo, Field("ver", Bytes(std::uint32_t{1})) +
                                               Field("chunk_pos", Bytes(offset)) +
                                               Field("start_time", StampBytes(chunk_start_ns_)) +
                                               Field("end_time", StampBytes(chunk_end_ns_)) +
                                               Field("count", Bytes(connection_count))) +
                    Block(counts);
  ++chunk_count_;
  chunk_.clear();
  chunk_index_.clear();
}

void Ros1BagWriter::Append(std::string_view bytes) {
  file_->Write(bytes);
  file_bytes_ += bytes.size();
}

std::string Ros1BagWriter::FileHeader(std::uint64_t index_pos) const {
  // As long as librosbag makes it, so that it can be overwritten whatever it says.
  constexpr std::size_t kPaddedBytes = 4096;
  const auto connection_count = static_cast<std::uint32_t>(connections_.size());
  const std::string header =
      Header(Op::kFileHeader, Field("index_pos", Bytes(index_pos)) +
                                  Field("conn_count", Bytes(connection_count)) +
                                  Field("chunk_count", Bytes(chunk_count_)));
  return header + Block(std::string(kPaddedBytes - header.size(), ' '));
}

}  // namespace trajlo
