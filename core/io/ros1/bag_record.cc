// SPDX-License-Identifier: MIT
#include "core/io/ros1/bag_record.h"

#include <algorithm>
#include <vector>

namespace trajlo::ros1 {
namespace {

// Headers are some tens of bytes plus a topic's name; the largest data outside of chunks are
// message definitions and the index of one chunk.
constexpr std::uint32_t kMaxHeaderBytes = 1U << 20U;
constexpr std::uint32_t kMaxDataBytes = 1U << 26U;

std::optional<std::uint32_t> TakeLength(std::string_view* bytes) {
  std::uint32_t length = 0;
  if (bytes->size() < sizeof(length)) return std::nullopt;
  std::memcpy(&length, bytes->data(), sizeof(length));
  bytes->remove_prefix(sizeof(length));
  return length;
}

/// A length and as many bytes.
std::optional<std::string_view> TakeBlock(std::string_view* bytes) {
  const auto length = TakeLength(bytes);
  if (!length || *length > bytes->size()) return std::nullopt;
  const std::string_view block = bytes->substr(0, *length);
  bytes->remove_prefix(*length);
  return block;
}

std::optional<Op> FindOp(const Fields& fields) {
  const auto op = fields.Number<std::uint8_t>("op");
  if (!op || *op < 2 || *op > 7) return std::nullopt;
  return static_cast<Op>(*op);
}

}  // namespace

std::optional<Fields> Fields::Parse(std::string_view header) {
  std::string_view rest = header;
  while (!rest.empty()) {
    const auto field = TakeBlock(&rest);
    if (!field || field->find('=') == field->npos) return std::nullopt;
  }
  return Fields(header);
}

std::optional<std::string_view> Fields::Find(std::string_view name) const {
  std::string_view rest = header_;
  while (const auto field = TakeBlock(&rest)) {
    if (field->size() > name.size() && (*field)[name.size()] == '=' &&
        field->substr(0, name.size()) == name) {
      return field->substr(name.size() + 1);
    }
  }
  return std::nullopt;
}

std::optional<std::int64_t> Fields::TimeNs(std::string_view name) const {
  const auto stamp = Number<std::uint64_t>(name);
  return stamp ? std::optional(ros1::TimeNs(*stamp)) : std::nullopt;
}

std::optional<RecordView> TakeRecord(std::string_view* bytes) {
  std::string_view rest = *bytes;
  const auto header = TakeBlock(&rest);
  if (!header) return std::nullopt;
  const auto fields = Fields::Parse(*header);
  const auto data = TakeBlock(&rest);
  if (!fields || !data) return std::nullopt;
  const auto op = FindOp(*fields);
  if (!op) return std::nullopt;
  *bytes = rest;
  return RecordView{*op, *fields, *data};
}

std::optional<FileRecord> ReadRecord(const RandomAccessFile& file, std::uint64_t offset) {
  char start[512];  // Holds most headers: one read instead of three.
  std::string_view rest(start, file.Read(offset, start, sizeof(start)));
  const auto length = TakeLength(&rest);
  if (!length || *length > kMaxHeaderBytes) return std::nullopt;
  std::string long_header;
  if (rest.size() < *length + sizeof(std::uint32_t)) {
    long_header.resize(*length + sizeof(std::uint32_t));
    if (file.Read(offset + sizeof(*length), long_header.data(), long_header.size()) <
        long_header.size()) {
      return std::nullopt;
    }
    rest = long_header;
  }
  FileRecord record;
  record.header = rest.substr(0, *length);
  rest.remove_prefix(*length);
  record.data_size = *TakeLength(&rest);
  record.data_offset = offset + 2 * sizeof(std::uint32_t) + *length;
  const auto fields = Fields::Parse(record.header);
  const auto op = fields ? FindOp(*fields) : std::nullopt;
  if (!op) return std::nullopt;
  record.op = *op;
  return record;
}

std::optional<std::string> ReadData(const RandomAccessFile& file, const FileRecord& record) {
  if (record.data_size > kMaxDataBytes || record.end() > file.size()) return std::nullopt;
  std::string data(record.data_size, '\0');
  if (file.Read(record.data_offset, data.data(), data.size()) < data.size()) return std::nullopt;
  return data;
}

std::uint64_t FindChunk(const RandomAccessFile& file, std::uint64_t offset) {
  // The field of a chunk's header that is the same in all: its length, "op=", 5.
  constexpr std::string_view kOpField("\4\0\0\0op=\5", 8);
  // What stands before it: the header's length, and perhaps, as writers differ in their order, the
  // fields "size=" (13 bytes) and "compression=" (19 or 20).
  constexpr std::uint64_t kBefore[] = {4, 4 + 13, 4 + 19, 4 + 20, 4 + 13 + 19, 4 + 13 + 20};
  // The next one may be near: what is read grows with the way to it.
  std::vector<char> window(1U << 12U);
  while (offset < file.size()) {
    const std::string_view bytes(window.data(), file.Read(offset, window.data(), window.size()));
    for (std::size_t at = bytes.find(kOpField); at != bytes.npos;
         at = bytes.find(kOpField, at + 1)) {
      for (const std::uint64_t before : kBefore) {
        if (at < before) continue;
        const auto record = ReadRecord(file, offset + at - before);
        if (record && record->op == Op::kChunk && record->fields().Find("compression")) {
          return offset + at - before;
        }
      }
    }
    if (bytes.size() < window.size()) break;
    offset += bytes.size() - 64;  // A header may lie across two windows.
    if (window.size() < (1U << 20U)) window.resize(2 * window.size());
  }
  return file.size();
}

std::optional<Connection> ParseConnection(const Fields& fields, std::string_view data) {
  const auto id = fields.Number<std::uint32_t>("conn");
  const auto topic = fields.Find("topic");
  const auto more = Fields::Parse(data);
  const auto type = more ? more->Find("type") : std::nullopt;
  if (!id || !topic || !type) return std::nullopt;
  return Connection{*id, std::string(*topic), std::string(*type), std::string(data)};
}

}  // namespace trajlo::ros1
