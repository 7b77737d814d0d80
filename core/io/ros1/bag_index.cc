// SPDX-License-Identifier: MIT
#include "core/io/ros1/bag_index.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "core/io/errors.h"
#include "core/io/format_text.h"

namespace trajlo::ros1 {
namespace {

void CheckIsBag(const RandomAccessFile& file) {
  std::string start(kMagic.size(), '\0');
  start.resize(file.Read(0, start.data(), start.size()));
  if (start == kMagic) return;
  if (start.rfind("#ROSBAG V1", 0) == 0) {
    throw InputError(file.path(), "this bag has the format of before 2010",
                     "Convert it with `rosbag filter old.bag new.bag True` of ROS 1.");
  }
  throw InputError(file.path(), "this is not a ROS 1 bag: it does not begin with \"#ROSBAG V2.0\"",
                   "Check that the file is what its name says.");
}

void CheckIsNotEncrypted(const RandomAccessFile& file) {
  const auto header = ReadRecord(file, kMagic.size());
  if (header && !header->fields().Find("encryptor").value_or("").empty()) {
    throw InputError(file.path(), "this bag is encrypted",
                     "Decrypt it with `rosbag decrypt` of ROS 1.");
  }
}

/// One record of the index; false if it is not what it should be.
bool AddIndexRecord(const FileRecord& record, const std::string& data, BagIndex* index) {
  const Fields fields = record.fields();
  if (record.op == Op::kConnection) {
    const auto connection = ParseConnection(fields, data);
    if (connection) index->AddConnection(*connection);
    return connection.has_value();
  }
  const auto version = fields.Number<std::uint32_t>("ver");
  const auto offset = fields.Number<std::uint64_t>("chunk_pos");
  const auto start_ns = fields.TimeNs("start_time");
  const auto count = fields.Number<std::uint32_t>("count");
  if (record.op != Op::kChunkInfo || version != 1U || !offset || !start_ns ||
      data.size() != std::uint64_t{8} * count.value_or(~0U)) {
    return false;
  }
  ChunkEntry chunk;
  chunk.offset = *offset;
  chunk.start_ns = *start_ns;
  std::map<std::uint32_t, std::uint64_t> counts;
  for (std::size_t at = 0; at < data.size(); at += 8) {
    std::uint32_t pair[2];
    std::memcpy(pair, data.data() + at, sizeof(pair));
    if (index->topic_of_connection.count(pair[0]) == 0) return false;
    counts[pair[0]] += pair[1];
  }
  index->AddChunk(std::move(chunk), counts);
  return true;
}

void SortByTime(BagIndex* index) {
  std::stable_sort(
      index->chunks.begin(), index->chunks.end(),
      [](const ChunkEntry& a, const ChunkEntry& b) { return a.start_ns < b.start_ns; });
}

/// Sets the limits; false unless all chunks lie apart from each other before `end`.
bool LimitChunks(std::uint64_t end, std::vector<ChunkEntry>* chunks) {
  std::sort(chunks->begin(), chunks->end(),
            [](const ChunkEntry& a, const ChunkEntry& b) { return a.offset < b.offset; });
  for (auto chunk = chunks->rbegin(); chunk != chunks->rend(); ++chunk) {
    if (chunk->offset < kMagic.size() || chunk->offset >= end) return false;
    chunk->limit = end;
    end = chunk->offset;
  }
  return true;
}

std::uint64_t CountMessages(const BagIndex& index) {
  std::uint64_t count = 0;
  for (const Topic& topic : index.topics) count += topic.messages;
  return count;
}

}  // namespace

void BagIndex::AddConnection(const Connection& connection) {
  if (!connections.try_emplace(connection.id, connection).second) return;
  const auto known = std::find_if(topics.begin(), topics.end(), [&](const Topic& topic) {
    return topic.name == connection.topic && topic.type == connection.type;
  });
  topic_of_connection[connection.id] = static_cast<std::size_t>(known - topics.begin());
  if (known == topics.end()) {
    topics.push_back({connection.topic, connection.type, Encoding::kRos1, 0});
    const Fields fields = connection.fields();
    const auto text = [&](const char* name) {
      return std::string(fields.Find(name).value_or(std::string_view()));
    };
    topics.back().interface = {connection.type, text("md5sum"), text("message_definition")};
    topics.back().is_latched = text("latching") == "1";
  }
  Topic& topic = topics[topic_of_connection[connection.id]];
  topic.messages += std::exchange(messages_of_unknown[connection.id], 0);
}

void BagIndex::AddChunk(ChunkEntry chunk, const std::map<std::uint32_t, std::uint64_t>& counts) {
  for (const auto& [connection, count] : counts) {
    const auto topic = topic_of_connection.find(connection);
    const bool is_known = topic != topic_of_connection.end();
    (is_known ? topics[topic->second].messages : messages_of_unknown[connection]) += count;
    chunk.connections.push_back(connection);
  }
  chunks.push_back(std::move(chunk));
}

bool ReadIndex(const RandomAccessFile& file, BagIndex* index, std::string* why) {
  const auto header = ReadRecord(file, kMagic.size());
  if (!header || header->op != Op::kFileHeader) {
    *why = "its header is broken";
    return false;
  }
  const auto index_pos = header->fields().Number<std::uint64_t>("index_pos").value_or(0);
  const auto connections = header->fields().Number<std::uint32_t>("conn_count");
  const auto chunks = header->fields().Number<std::uint32_t>("chunk_count");
  if (index_pos == 0) {
    *why = "it was never closed and has no index";
    return false;
  }
  if (index_pos < header->end() || index_pos > file.size()) {
    *why = "the file ends at byte " + std::to_string(file.size()) +
           " and its index should begin at byte " + std::to_string(index_pos);
    return false;
  }
  std::uint64_t offset = index_pos;
  std::uint32_t records = 0;
  for (; offset < file.size(); ++records) {
    const auto record = ReadRecord(file, offset);
    const auto data = record ? ReadData(file, *record) : std::nullopt;
    if (!data || !AddIndexRecord(*record, *data, index)) {
      *why = "its index is cut or broken at byte " + std::to_string(offset);
      return false;
    }
    offset = record->end();
  }
  if (index->chunks.size() != chunks ||
      records != std::uint64_t{*chunks} + connections.value_or(0) ||
      !LimitChunks(index_pos, &index->chunks)) {
    *why = "its index is not complete";
    return false;
  }
  SortByTime(index);
  return true;
}

BagIndex BuildIndex(const RandomAccessFile& file, DamageLog* log) {
  CheckIsBag(file);
  CheckIsNotEncrypted(file);
  BagIndex index;
  std::string why;
  if (ReadIndex(file, &index, &why)) return index;
  index = ScanBag(file, log);
  SortByTime(&index);
  const std::uint64_t messages = CountMessages(index);
  if (messages == 0) {
    throw InputError(file.path(),
                     "this bag is damaged (" + why + ") and no message was found in it",
                     "Copy it again from where it was recorded.");
  }
  log->AddSummary(why + "; a scan found " + CountOf(messages, "message") + " in " +
                  CountOf(index.chunks.size(), "chunk"));
  return index;
}

}  // namespace trajlo::ros1
