// SPDX-License-Identifier: MIT
#include "core/io/pcd_reader.h"

#include <lzf.h>

#include <algorithm>
#include <cstdint>
#include <optional>

#include "core/io/ascii_table.h"
#include "core/io/errors.h"
#include "core/io/number_text.h"

namespace trajlo {
namespace {

constexpr char kMend[] = "Write the file again as PCD 0.7, or remove it from the folder.";

struct PcdField {
  std::string name;
  ScalarType type = ScalarType::kFloat32;
  std::size_t repeat = 1;
  std::size_t Bytes() const { return SizeOf(type) * repeat; }
};

enum class PcdData { kAscii, kBinary, kCompressed };

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t points = 0;
  PcdData data = PcdData::kAscii;
  std::size_t data_offset = 0;

  std::size_t RowBytes() const {
    std::size_t sum = 0;
    for (const PcdField& field : fields) sum += field.Bytes();
    return sum;
  }
};

std::optional<std::uint64_t> ParseCount(std::string_view word) {
  const auto value = ParseWhole(word);
  // Beyond 2^40 a product of two of them, or with a row's size, could overflow.
  return value && *value <= (1ULL << 40) ? value : std::nullopt;
}

std::optional<ScalarType> TypeOf(std::string_view kind, std::string_view size) {
  const std::string key = std::string(kind) + std::string(size);
  if (key == "F4") return ScalarType::kFloat32;
  if (key == "F8") return ScalarType::kFloat64;
  if (key == "I1") return ScalarType::kInt8;
  if (key == "I2") return ScalarType::kInt16;
  if (key == "I4") return ScalarType::kInt32;
  if (key == "I8") return ScalarType::kInt64;
  if (key == "U1") return ScalarType::kUint8;
  if (key == "U2") return ScalarType::kUint16;
  if (key == "U4") return ScalarType::kUint32;
  if (key == "U8") return ScalarType::kUint64;
  return {};
}

std::vector<std::string_view> Words(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::string_view word = TakeWord(&line); !word.empty(); word = TakeWord(&line)) {
    words.push_back(word);
  }
  return words;
}

/// The lines of the header as written, before they are checked against each other.
struct HeaderLines {
  std::vector<std::string_view> names, sizes, kinds, repeats, width, height, points, data;
};

class HeaderParser {
 public:
  HeaderParser(const std::filesystem::path& path, std::string_view file)
      : path_(path), file_(file) {}

  PcdHeader Parse() {
    SplitLines();
    PcdHeader header;
    header.data_offset = data_offset_;
    header.data = ParseDataKind();
    header.fields = ParseFields();
    header.points = ParsePoints();
    // Within these bounds points * row bytes cannot overflow.
    const std::size_t row_bytes = header.RowBytes();
    if (row_bytes == 0 || row_bytes > (1U << 20)) {
      Fail("a point of " + std::to_string(row_bytes) + " bytes");
    }
    return header;
  }

 private:
  [[noreturn]] void Fail(const std::string& found) const {
    throw InputError(path_, "PCD header: " + found, kMend);
  }

  void SplitLines() {
    std::string_view rest = file_;
    std::string_view line;
    while (lines_.data.empty() && TakeLine(&rest, &line)) {
      std::vector<std::string_view> words = Words(line);
      if (words.empty() || words.front().front() == '#') continue;
      const std::string_view key = words.front();
      std::vector<std::string_view>* target = key == "FIELDS" || key == "COLUMNS" ? &lines_.names
                                              : key == "SIZE"                     ? &lines_.sizes
                                              : key == "TYPE"                     ? &lines_.kinds
                                              : key == "COUNT"                    ? &lines_.repeats
                                              : key == "WIDTH"                    ? &lines_.width
                                              : key == "HEIGHT"                   ? &lines_.height
                                              : key == "POINTS"                   ? &lines_.points
                                              : key == "DATA"                     ? &lines_.data
                                                                                  : nullptr;
      if (target != nullptr) target->assign(words.begin() + 1, words.end());
      data_offset_ = file_.size() - rest.size();
      if (key == "DATA" && lines_.data.empty()) break;
    }
    if (lines_.data.empty()) Fail("no DATA line in " + std::to_string(file_.size()) + " bytes");
  }

  PcdData ParseDataKind() const {
    const std::string_view kind = lines_.data.front();
    if (kind == "ascii") return PcdData::kAscii;
    if (kind == "binary") return PcdData::kBinary;
    if (kind == "binary_compressed") return PcdData::kCompressed;
    Fail("DATA '" + std::string(kind) + "' is none of ascii, binary, binary_compressed");
  }

  std::vector<PcdField> ParseFields() const {
    const std::size_t n = lines_.names.size();
    if (n == 0) Fail("no FIELDS line");
    if (lines_.sizes.size() != n || lines_.kinds.size() != n ||
        (!lines_.repeats.empty() && lines_.repeats.size() != n)) {
      Fail(std::to_string(n) + " FIELDS, but " + std::to_string(lines_.sizes.size()) + " SIZE, " +
           std::to_string(lines_.kinds.size()) + " TYPE and " +
           std::to_string(lines_.repeats.size()) + " COUNT values");
    }
    std::vector<PcdField> fields(n);
    for (std::size_t i = 0; i < n; ++i) {
      const auto type = TypeOf(lines_.kinds[i], lines_.sizes[i]);
      const auto repeat =
          lines_.repeats.empty() ? std::optional<std::uint64_t>(1) : ParseCount(lines_.repeats[i]);
      if (!type || !repeat || *repeat > 65536) {
        Fail("field '" + std::string(lines_.names[i]) + "' has TYPE, SIZE or COUNT out of range");
      }
      fields[i] = {std::string(lines_.names[i]), *type, static_cast<std::size_t>(*repeat)};
    }
    return fields;
  }

  std::uint64_t ParsePoints() const {
    if (!lines_.points.empty()) {
      if (const auto points = ParseCount(lines_.points.front())) return *points;
      Fail("POINTS is not a usable number");
    }
    if (lines_.width.empty()) Fail("neither POINTS nor WIDTH");
    const auto width = ParseCount(lines_.width.front());
    const auto height =
        lines_.height.empty() ? std::optional<std::uint64_t>(1) : ParseCount(lines_.height.front());
    if (!width || !height || (*height > 0 && *width > (1ULL << 40) / *height)) {
      Fail("WIDTH and HEIGHT are not usable numbers");
    }
    return *width * *height;
  }

  const std::filesystem::path& path_;
  std::string_view file_;
  HeaderLines lines_;
  std::size_t data_offset_ = 0;
};

bool IsPadding(const PcdField& field) { return field.name == "_" || field.repeat == 0; }

PointTable ReadAscii(const PcdHeader& header, std::string_view body) {
  std::vector<AsciiField> fields;
  for (const PcdField& field : header.fields) {
    fields.push_back({field.name, field.type, field.repeat, false});
  }
  return ParseAsciiTable(body, fields, static_cast<std::size_t>(header.points), true);
}

PointTable ReadBinary(const PcdHeader& header, FileBytes bytes) {
  const std::size_t row_bytes = header.RowBytes();
  PointTable table;
  const std::size_t available = bytes.size() - header.data_offset;
  const std::size_t whole_rows = available / row_bytes;
  table.count = static_cast<std::size_t>(std::min<std::uint64_t>(header.points, whole_rows));
  if (available != header.points * row_bytes) {
    table.damage = "POINTS " + std::to_string(header.points) + " of " + std::to_string(row_bytes) +
                   " bytes declared, " + std::to_string(available) + " bytes (" +
                   std::to_string(whole_rows) + " points) follow the header, which ends at byte " +
                   std::to_string(header.data_offset);
  }
  std::size_t offset = header.data_offset;
  for (const PcdField& field : header.fields) {
    if (!IsPadding(field)) {
      table.columns.push_back({field.name, field.type, offset, row_bytes, false});
    }
    offset += field.Bytes();
  }
  table.bytes = std::move(bytes);
  return table;
}

/// Unpacks the block: two uint32 (packed and unpacked size), then all values field by field.
PointTable ReadCompressed(const std::filesystem::path& path, const PcdHeader& header,
                          const FileBytes& bytes) {
  const auto fail = [&](const std::string& found) {
    throw InputError(
        path, "compressed block at byte " + std::to_string(header.data_offset) + ": " + found,
        kMend);
  };
  std::uint32_t sizes[2] = {0, 0};
  const std::size_t available = bytes.size() - header.data_offset;
  if (available < sizeof(sizes)) fail("its two sizes are cut off");
  std::memcpy(sizes, bytes.data() + header.data_offset, sizeof(sizes));
  const std::uint64_t packed = sizes[0];
  const std::uint64_t unpacked = sizes[1];
  if (packed > available - sizeof(sizes)) {
    fail(std::to_string(packed) + " packed bytes declared, " +
         std::to_string(available - sizeof(sizes)) + " there");
  }
  const std::uint64_t row_bytes = header.RowBytes();
  if (header.points * row_bytes != unpacked) {
    fail(std::to_string(header.points) + " points of " + std::to_string(row_bytes) +
         " bytes declared, but the block unpacks to " + std::to_string(unpacked) + " bytes");
  }
  // Three packed bytes give 264 at most: a larger claim is not worth an allocation.
  if (unpacked > packed * 88 + 264) fail("the unpacked size is impossible");

  PointTable table;
  table.bytes = FileBytes(static_cast<std::size_t>(unpacked));
  const char* block = bytes.data() + header.data_offset + sizeof(sizes);
  if (unpacked > 0 && lzf_decompress(block, sizes[0], table.bytes.data(), sizes[1]) != sizes[1]) {
    fail("the packed bytes are not valid LZF data");
  }
  table.count = static_cast<std::size_t>(header.points);
  std::size_t offset = 0;
  for (const PcdField& field : header.fields) {
    if (!IsPadding(field)) {
      table.columns.push_back({field.name, field.type, offset, field.Bytes(), false});
    }
    offset += field.Bytes() * table.count;
  }
  return table;
}

}  // namespace

PointTable ReadPcd(const std::filesystem::path& path, FileBytes bytes) {
  const PcdHeader header = HeaderParser(path, bytes.view()).Parse();
  switch (header.data) {
    case PcdData::kAscii:
      return ReadAscii(header, bytes.view().substr(header.data_offset));
    case PcdData::kBinary:
      return ReadBinary(header, std::move(bytes));
    case PcdData::kCompressed:
      return ReadCompressed(path, header, bytes);
  }
  throw InputError(path, "unknown PCD data kind", kMend);
}

}  // namespace trajlo
