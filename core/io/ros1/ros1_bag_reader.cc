// SPDX-License-Identifier: MIT
#include "core/io/ros1/ros1_bag_reader.h"

#include <algorithm>
#include <string>

namespace trajlo {
namespace {

constexpr std::size_t kMaxHeldBytes = std::size_t{64} << 20U;

}  // namespace

Ros1BagReader::Ros1BagReader(const std::filesystem::path& path, int threads)
    : file_(path),
      log_(path),
      index_(ros1::BuildIndex(file_, &log_)),
      selected_(index_.topics.size(), true),
      reader_(file_),
      ahead_(file_, threads) {}

void Ros1BagReader::Select(const std::vector<std::size_t>& topics) {
  selected_.assign(index_.topics.size(), false);
  for (const std::size_t topic : topics) selected_.at(topic) = true;
}

bool Ros1BagReader::Next(RawMessage* message) {
  while (true) {
    // Whatever chunk may hold an earlier message than those that are open has to be opened first.
    while (next_chunk_ < index_.chunks.size() &&
           (heads_.empty() || index_.chunks[next_chunk_].start_ns < heads_.top().first)) {
      Open(next_chunk_++);
    }
    if (heads_.empty()) return false;
    const auto open = open_.find(heads_.top().second);
    heads_.pop();
    const bool taken = Take(&*open, message);
    OpenChunk& chunk = open->second;
    if (chunk.next < chunk.messages.size()) {
      heads_.emplace(chunk.messages[chunk.next].recorded_ns, open->first);
    } else {
      held_bytes_ -= chunk.bytes.size();
      read_.bytes = std::move(chunk.bytes);
      open_.erase(open);
    }
    if (taken) return true;
  }
}

bool Ros1BagReader::IsSelected(std::uint32_t connection) const {
  const auto topic = index_.topic_of_connection.find(connection);
  return topic != index_.topic_of_connection.end() && selected_[topic->second];
}

bool Ros1BagReader::IsWanted(std::size_t chunk) const {
  const std::vector<std::uint32_t>& connections = index_.chunks[chunk].connections;
  return std::any_of(connections.begin(), connections.end(),
                     [this](std::uint32_t connection) { return IsSelected(connection); });
}

/// Chunks are opened in the order of the index, so that the next ones are known.
void Ros1BagReader::StartAhead() {
  next_ahead_ = std::max(next_ahead_, next_chunk_);
  for (; next_ahead_ < index_.chunks.size(); ++next_ahead_) {
    if (!IsWanted(next_ahead_)) continue;
    const ros1::ChunkEntry& entry = index_.chunks[next_ahead_];
    if (!ahead_.Start(entry.offset, entry.limit)) return;
  }
}

void Ros1BagReader::Open(std::size_t chunk) {
  if (!IsWanted(chunk)) return;
  ros1::ChunkEntry& entry = index_.chunks[chunk];
  if (!ahead_.Take(entry.offset, &read_)) reader_.Read(entry.offset, entry.limit, &read_);
  StartAhead();
  if (!read_.damage.empty() && !entry.damage_logged) {
    log_.Add(entry.offset, read_.damage, read_.bytes_lost);
    entry.damage_logged = true;
  }
  std::uint64_t unknown_bytes = 0;
  OpenChunk open;
  for (const ros1::MessagePlace& place : read_.messages) {
    if (index_.topic_of_connection.count(place.connection) == 0) unknown_bytes += place.size;
    if (IsSelected(place.connection)) open.messages.push_back(place);
  }
  if (unknown_bytes > 0) log_.Add(entry.offset, "messages of an unknown topic", unknown_bytes);
  if (open.messages.empty()) return;
  std::stable_sort(open.messages.begin(), open.messages.end(),
                   [](const ros1::MessagePlace& a, const ros1::MessagePlace& b) {
                     return a.recorded_ns < b.recorded_ns;
                   });
  open.bytes = std::move(read_.bytes);
  held_bytes_ += open.bytes.size();
  heads_.emplace(open.messages.front().recorded_ns, chunk);
  open_.emplace(chunk, std::move(open));
  MakeRoom(chunk);
}

void Ros1BagReader::Load(OpenChunks::value_type* open) {
  const ros1::ChunkEntry& entry = index_.chunks[open->first];
  reader_.Read(entry.offset, entry.limit, &read_);
  open->second.bytes = std::move(read_.bytes);
  held_bytes_ += open->second.bytes.size();
  MakeRoom(open->first);
}

void Ros1BagReader::MakeRoom(std::size_t chunk) {
  while (held_bytes_ > kMaxHeldBytes) {
    // Drops what is needed last.
    OpenChunk* last = nullptr;
    std::int64_t last_ns = 0;
    for (auto& [other, open] : open_) {
      if (other == chunk || open.bytes.size() == 0) continue;
      const std::int64_t next_ns = open.messages[open.next].recorded_ns;
      if (last == nullptr || next_ns > last_ns) {
        last = &open;
        last_ns = next_ns;
      }
    }
    if (last == nullptr) return;
    held_bytes_ -= last->bytes.size();
    last->bytes = ros1::ByteBuffer();
  }
}

bool Ros1BagReader::Take(OpenChunks::value_type* open, RawMessage* message) {
  OpenChunk& chunk = open->second;
  const ros1::MessagePlace& place = chunk.messages[chunk.next++];
  if (chunk.bytes.size() == 0) Load(open);
  if (chunk.bytes.size() < std::size_t{place.offset} + place.size) {
    log_.Add(index_.chunks[open->first].offset, "the file has changed while it was read",
             place.size);
    return false;
  }
  connection_ = place.connection;
  message->topic = index_.topic_of_connection.at(connection_);
  message->recorded_ns = place.recorded_ns;
  if (message->bytes.size() < place.size) {
    message->bytes = FileBytes(place.size);
  } else {
    message->bytes.Shrink(place.size);
  }
  // Not memcpy: of a message without bytes the pointers are null.
  std::copy_n(chunk.bytes.data() + place.offset, place.size, message->bytes.data());
  return true;
}

}  // namespace trajlo
