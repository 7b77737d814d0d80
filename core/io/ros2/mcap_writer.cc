// SPDX-License-Identifier: MIT
#include "core/io/ros2/mcap_writer.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "core/io/errors.h"
#include "core/io/messages/wire_writer.h"
#include "core/io/ros2/pack.h"
#include "core/io/ros2/qos.h"

namespace trajlo {
namespace {

/// Our own reader's limit of a chunk, and that of lengths in 32 bits.
constexpr std::size_t kMaxMessage = std::size_t{1} << 29U;
/// A chunk in which times go back by more is ended, so that who seeks need not read it in vain.
constexpr std::uint64_t kLargestStepBack_ns = 1'000'000'000;

WireWriter Content() { return WireWriter(Encoding::kRos1); }

std::string Record(McapOpcode opcode, std::string_view content) {
  return Content()
      .Put(static_cast<std::uint8_t>(opcode))
      .Put(static_cast<std::uint64_t>(content.size()))
      .PutBytes(content)
      .Take();
}

std::uint32_t Crc(std::string_view bytes) {
  const auto* begin = reinterpret_cast<const Bytef*>(bytes.data());
  return static_cast<std::uint32_t>(::crc32_z(0, begin, bytes.size()));
}

std::string CompressionName(const std::optional<Codec>& codec) {
  if (!codec) return "";
  return *codec == Codec::kZstd ? "zstd" : "lz4";
}

}  // namespace

McapWriter::McapWriter(const std::filesystem::path& path, const McapOptions& options)
    : path_(path), options_(options) {
  file_.emplace(path, options.if_exists);
  Append(std::string(kMcapMagic) +
         Record(McapOpcode::kHeader, Content().PutString("ros2").PutString("trajlo").bytes()));
}

void McapWriter::Write(const TopicDescription& topic, std::int64_t recorded_ns,
                       std::string_view message) {
  if (!file_) throw OutputError(path_, "writing after Close");
  if (recorded_ns < 0) {
    throw OutputError(path_, "an MCAP file cannot hold the stamp " + std::to_string(recorded_ns) +
                                 " ns, which is before 1970");
  }
  if (message.size() > kMaxMessage) {
    throw OutputError(path_,
                      "a message of " + std::to_string(message.size()) + " bytes is too long");
  }
  const auto t_ns = static_cast<std::uint64_t>(recorded_ns);
  if (!chunk_index_.empty() && t_ns + kLargestStepBack_ns < chunk_start_ns_) FinishChunk();
  Channel& channel = ChannelOf(topic);
  const bool first = chunk_index_.empty();
  chunk_start_ns_ = first ? t_ns : std::min(chunk_start_ns_, t_ns);
  chunk_end_ns_ = first ? t_ns : std::max(chunk_end_ns_, t_ns);
  chunk_index_[channel.id] +=
      Content().Put(t_ns).Put(static_cast<std::uint64_t>(chunk_.size())).bytes();
  chunk_ += Record(McapOpcode::kMessage, Content()
                                             .Put(channel.id)
                                             .Put(channel.messages++)
                                             .Put(t_ns)
                                             .Put(t_ns)  // When it was published.
                                             .PutBytes(message)
                                             .bytes());
  if (chunk_.size() > options_.chunk_bytes) FinishChunk();
}

void McapWriter::Close() {
  if (!file_) return;
  FinishChunk();
  constexpr std::uint32_t kNoCrc = 0;
  Append(Record(McapOpcode::kDataEnd, Content().Put(kNoCrc).bytes()));
  WriteSummary();
  Append(kMcapMagic);
  file_->Commit();
  file_.reset();
}

std::uint16_t McapWriter::SchemaOf(const MessageDescription& message) {
  // 0 means that there is none.
  const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
  const auto [place, is_new] = schemas_.try_emplace(Ros2TypeName(message.type), id);
  if (is_new) {
    const std::string record = Record(McapOpcode::kSchema, Content()
                                                               .Put(id)
                                                               .PutString(place->first)
                                                               .PutString(Ros2Language(message))
                                                               .PutString(Ros2Text(message))
                                                               .bytes());
    schema_records_ += record;
    chunk_ += record;
  }
  return place->second;
}

McapWriter::Channel& McapWriter::ChannelOf(const TopicDescription& topic) {
  const auto [place, is_new] = channels_.try_emplace(topic.name + " " + topic.message.type);
  Channel& channel = place->second;
  if (!is_new) return channel;
  if (channels_.size() > std::numeric_limits<std::uint16_t>::max()) {
    throw OutputError(path_, "an MCAP file has room for 65535 topics");
  }
  channel.id = static_cast<std::uint16_t>(channels_.size() - 1);
  const std::string metadata =
      Content().PutString("offered_qos_profiles").PutString(QosText(topic)).Take();
  const std::uint16_t schema = SchemaOf(topic.message);
  const std::string record = Record(McapOpcode::kChannel, Content()
                                                              .Put(channel.id)
                                                              .Put(schema)
                                                              .PutString(topic.name)
                                                              .PutString("cdr")
                                                              .PutBlock(metadata)
                                                              .bytes());
  channel_records_ += record;
  chunk_ += record;
  return channel;
}

void McapWriter::FinishChunk() {
  if (chunk_index_.empty()) return;
  start_ns_ = chunk_count_ == 0 ? chunk_start_ns_ : std::min(start_ns_, chunk_start_ns_);
  end_ns_ = std::max(end_ns_, chunk_end_ns_);
  if (options_.compression) {
    WriteChunk(Pack(*options_.compression, chunk_));
  } else {
    WriteChunk(chunk_);
  }
  ++chunk_count_;
  chunk_.clear();
  chunk_index_.clear();
}

void McapWriter::WriteChunk(std::string_view stored) {
  const std::uint64_t offset = file_bytes_;
  WireWriter head = Content();
  head.Put(chunk_start_ns_).Put(chunk_end_ns_).Put(static_cast<std::uint64_t>(chunk_.size()));
  head.Put(Crc(chunk_)).PutString(CompressionName(options_.compression));
  head.Put(static_cast<std::uint64_t>(stored.size()));
  Append(Content()
             .Put(static_cast<std::uint8_t>(McapOpcode::kChunk))
             .Put(static_cast<std::uint64_t>(head.size() + stored.size()))
             .PutBytes(head.bytes())
             .bytes());
  Append(stored);
  AddChunkIndex(offset, stored.size());
}

/// Behind a chunk stands where its messages are; the summary says where that stands.
void McapWriter::AddChunkIndex(std::uint64_t chunk_offset, std::size_t stored_size) {
  const std::uint64_t index_offset = file_bytes_;
  WireWriter places = Content();
  for (const auto& [channel, messages] : chunk_index_) {
    places.Put(channel).Put(file_bytes_);
    message_count_ += messages.size() / 16;
    Append(Record(McapOpcode::kMessageIndex, Content().Put(channel).PutBlock(messages).bytes()));
  }
  chunk_records_ +=
      Record(McapOpcode::kChunkIndex, Content()
                                          .Put(chunk_start_ns_)
                                          .Put(chunk_end_ns_)
                                          .Put(chunk_offset)
                                          .Put(index_offset - chunk_offset)
                                          .PutBlock(places.bytes())
                                          .Put(file_bytes_ - index_offset)
                                          .PutString(CompressionName(options_.compression))
                                          .Put(static_cast<std::uint64_t>(stored_size))
                                          .Put(static_cast<std::uint64_t>(chunk_.size()))
                                          .bytes());
}

std::string McapWriter::StatisticsRecord() const {
  WireWriter counts = Content();
  for (const auto& [name, channel] : channels_) {
    counts.Put(channel.id).Put(std::uint64_t{channel.messages});
  }
  return Record(McapOpcode::kStatistics, Content()
                                             .Put(message_count_)
                                             .Put(static_cast<std::uint16_t>(schemas_.size()))
                                             .Put(static_cast<std::uint32_t>(channels_.size()))
                                             .Put(std::uint32_t{0})  // attachments
                                             .Put(std::uint32_t{0})  // metadata
                                             .Put(chunk_count_)
                                             .Put(start_ns_)
                                             .Put(end_ns_)
                                             .PutBlock(counts.bytes())
                                             .bytes());
}

void McapWriter::WriteSummary() {
  const std::string statistics = StatisticsRecord();
  const std::pair<McapOpcode, std::string_view> groups[] = {
      {McapOpcode::kSchema, schema_records_},
      {McapOpcode::kChannel, channel_records_},
      {McapOpcode::kStatistics, statistics},
      {McapOpcode::kChunkIndex, chunk_records_}};
  std::string summary, offsets;
  for (const auto& [opcode, records] : groups) {
    if (records.empty()) continue;
    offsets +=
        Record(McapOpcode::kSummaryOffset, Content()
                                               .Put(static_cast<std::uint8_t>(opcode))
                                               .Put(file_bytes_ + summary.size())
                                               .Put(static_cast<std::uint64_t>(records.size()))
                                               .bytes());
    summary += records;
  }
  const std::uint64_t offsets_start = file_bytes_ + summary.size();
  // The checksum covers the footer, too, up to itself.
  constexpr std::uint64_t kFooterContent = 8 + 8 + 4;
  summary += offsets;
  summary += Content()
                 .Put(static_cast<std::uint8_t>(McapOpcode::kFooter))
                 .Put(kFooterContent)
                 .Put(file_bytes_)
                 .Put(offsets_start)
                 .bytes();
  Append(summary + Content().Put(Crc(summary)).bytes());
}

void McapWriter::Append(std::string_view bytes) {
  file_->Write(bytes);
  file_bytes_ += bytes.size();
}

}  // namespace trajlo
