// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "core/io/random_access_file.h"
#include "core/scans/nanoseconds.h"

namespace trajlo::ros1 {

// A bag (format 2.0, wiki.ros.org/Bags/Format/2.0) is the line kMagic and then records. A record is
//   uint32 header length | header | uint32 data length | data
// and a header is a sequence of fields
//   uint32 length | name=value
// All numbers are little-endian. Chunk records hold connection and message records.
inline constexpr std::string_view kMagic = "#ROSBAG V2.0\n";

enum class Op : std::uint8_t {
  kMessage = 2,
  kFileHeader = 3,
  kIndexData = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7,
};

/// The fields of a header; a view onto bytes that the caller keeps.
class Fields {
 public:
  /// Nothing if `header` is not a sequence of fields.
  static std::optional<Fields> Parse(std::string_view header);

  std::optional<std::string_view> Find(std::string_view name) const;
  /// Nothing if there is no such field or if it has another size.
  template <typename T>
  std::optional<T> Number(std::string_view name) const {
    const auto value = Find(name);
    if (!value || value->size() != sizeof(T)) return std::nullopt;
    T number;
    std::memcpy(&number, value->data(), sizeof(T));
    return number;
  }
  std::optional<std::int64_t> TimeNs(std::string_view name) const;

 private:
  explicit Fields(std::string_view header) : header_(header) {}
  std::string_view header_;
};

/// A stamp as the format stores it: seconds in the low, nanoseconds in the high half.
inline std::int64_t TimeNs(std::uint64_t stamp) {
  return static_cast<std::int64_t>(stamp & 0xffffffffU) * kNsPerSecond +
         static_cast<std::int64_t>(stamp >> 32U);
}

/// A record inside a block of bytes.
struct RecordView {
  Op op = Op::kMessage;
  Fields fields;
  std::string_view data;
};

/// Takes the first record off the front of `bytes`; nothing if there is no whole record.
std::optional<RecordView> TakeRecord(std::string_view* bytes);

/// A record of a file, without its data, which may reach beyond the end of the file.
struct FileRecord {
  Op op = Op::kMessage;
  std::string header;
  std::uint64_t data_offset = 0;
  std::uint32_t data_size = 0;

  Fields fields() const { return *Fields::Parse(header); }
  std::uint64_t end() const { return data_offset + data_size; }
};

std::optional<FileRecord> ReadRecord(const RandomAccessFile& file, std::uint64_t offset);
/// The data of a record; nothing if it is cut or too large for what such records hold.
std::optional<std::string> ReadData(const RandomAccessFile& file, const FileRecord& record);

/// Where the next chunk record begins, at `offset` or behind it; the file's size if there is none.
std::uint64_t FindChunk(const RandomAccessFile& file, std::uint64_t offset);

/// One publisher of a topic.
struct Connection {
  std::uint32_t id = 0;
  std::string topic;
  std::string type;
  /// All that the bag says of it, as fields: type, md5sum, message_definition, and where the
  /// recorder knew them callerid and latching.
  std::string header;

  Fields fields() const { return *Fields::Parse(header); }
};

std::optional<Connection> ParseConnection(const Fields& fields, std::string_view data);

}  // namespace trajlo::ros1
