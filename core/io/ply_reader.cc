// SPDX-License-Identifier: MIT
#include "core/io/ply_reader.h"

#include <algorithm>
#include <optional>

#include "core/io/ascii_table.h"
#include "core/io/errors.h"
#include "core/io/ply_header.h"

namespace trajlo {
namespace {

/// Reads an integer of either byte order at `at`; a negative one becomes huge and fails later.
std::uint64_t ReadCount(const char* at, ScalarType type, bool swap_bytes) {
  std::uint64_t value = 0;
  const std::size_t size = SizeOf(type);
  for (std::size_t k = 0; k < size; ++k) {
    const auto byte = static_cast<unsigned char>(at[swap_bytes ? size - 1 - k : k]);
    value |= static_cast<std::uint64_t>(byte) << (8 * k);
  }
  return value;
}

/// Finds the end of the row of `element` that begins at byte `at`; nothing if it is cut off.
/// `visit(property, offset)` is called for each property that is not a list.
template <typename Visitor>
std::optional<std::size_t> WalkRow(const PlyElement& element, std::string_view file, bool swap,
                                   std::size_t at, Visitor&& visit) {
  for (const PlyProperty& property : element.properties) {
    std::uint64_t count = 1;
    if (property.is_list) {
      const std::size_t count_size = SizeOf(property.count_type);
      if (file.size() - at < count_size) return {};
      count = ReadCount(file.data() + at, property.count_type, swap);
      at += count_size;
    }
    if (count > (file.size() - at) / SizeOf(property.type)) return {};
    if (!property.is_list) visit(property, at);
    at += static_cast<std::size_t>(count) * SizeOf(property.type);
  }
  return at;
}

/// The byte behind all rows of an element that comes before the vertices; nothing if cut off.
std::optional<std::size_t> SkipElement(const PlyElement& element, std::string_view file, bool swap,
                                       std::size_t at) {
  if (!element.HasList()) {
    const std::size_t row_bytes = element.RowBytes();
    if (row_bytes > 0 && element.count > (file.size() - at) / row_bytes) return {};
    return at + static_cast<std::size_t>(element.count) * row_bytes;
  }
  for (std::uint64_t row = 0; row < element.count; ++row) {
    const auto end = WalkRow(element, file, swap, at, [](const PlyProperty&, std::size_t) {});
    if (!end) return {};
    at = *end;
  }
  return at;
}

/// Rows of one size that follow the declared ones where the file should end.
std::size_t RowsBehind(const PlyHeader& header, std::size_t bytes_there) {
  const PlyElement& vertex = header.elements[header.vertex];
  if (vertex.HasList() || header.vertex + 1 < header.elements.size()) return 0;
  const std::size_t row_bytes = vertex.RowBytes();
  if (row_bytes == 0 || bytes_there / row_bytes <= vertex.count) return 0;
  return bytes_there / row_bytes - static_cast<std::size_t>(vertex.count);
}

void NoteMissing(const PlyElement& vertex, std::size_t bytes_there, PointTable* table) {
  if (table->count == vertex.count) return;
  table->damage = std::to_string(vertex.count) + " vertices declared, " +
                  std::to_string(table->count) + " whole ones in the " +
                  std::to_string(bytes_there) + " bytes after the header";
}

/// Rows of one size: the columns point straight into the file.
PointTable ViewRows(const PlyElement& vertex, FileBytes bytes, bool swap, std::size_t at) {
  PointTable table;
  const std::size_t row_bytes = vertex.RowBytes();
  if (row_bytes == 0) return table;
  const std::uint64_t there = (bytes.size() - at) / row_bytes;
  table.count = static_cast<std::size_t>(std::min(vertex.count, there));
  std::size_t offset = at;
  for (const PlyProperty& property : vertex.properties) {
    table.columns.push_back({property.name, property.type, offset, row_bytes, swap});
    offset += SizeOf(property.type);
  }
  table.bytes = std::move(bytes);
  return table;
}

/// Rows with lists have different lengths: the other properties are copied together.
PointTable GatherRows(const PlyElement& vertex, std::string_view file, bool swap, std::size_t at) {
  PointTable table;
  std::size_t row_bytes = 0;
  std::size_t smallest_row = 0;
  for (const PlyProperty& property : vertex.properties) {
    smallest_row += SizeOf(property.is_list ? property.count_type : property.type);
    if (property.is_list) continue;
    table.columns.push_back({property.name, property.type, row_bytes, 0, swap});
    row_bytes += SizeOf(property.type);
  }
  if (row_bytes == 0) return table;
  for (Column& column : table.columns) column.stride = row_bytes;
  const std::uint64_t possible = (file.size() - at) / smallest_row;
  table.bytes = FileBytes(static_cast<std::size_t>(std::min(vertex.count, possible)) * row_bytes);
  while (table.count < vertex.count) {
    char* out = table.bytes.data() + table.count * row_bytes;
    if (out + row_bytes > table.bytes.data() + table.bytes.size()) break;
    const auto end = WalkRow(vertex, file, swap, at, [&](const PlyProperty& p, std::size_t from) {
      std::memcpy(out, file.data() + from, SizeOf(p.type));
      out += SizeOf(p.type);
    });
    if (!end) break;
    at = *end;
    ++table.count;
  }
  return table;
}

PointTable ReadAscii(const PlyHeader& header, std::string_view body) {
  std::string_view line;
  for (std::size_t i = 0; i < header.vertex; ++i) {
    for (std::uint64_t row = 0; row < header.elements[i].count; ++row) {
      if (!TakeLine(&body, &line)) break;
    }
  }
  const PlyElement& vertex = header.elements[header.vertex];
  std::vector<AsciiField> fields;
  for (const PlyProperty& property : vertex.properties) {
    fields.push_back({property.name, property.type, 1, property.is_list});
  }
  return ParseAsciiTable(body, fields, static_cast<std::size_t>(vertex.count),
                         header.vertex + 1 == header.elements.size());
}

}  // namespace

PointTable ReadPly(const std::filesystem::path& path, FileBytes bytes) {
  const PlyHeader header = ParsePlyHeader(path, bytes.view());
  if (header.format == PlyFormat::kAscii) {
    return ReadAscii(header, bytes.view().substr(header.data_offset));
  }
  const bool swap = header.format == PlyFormat::kBigEndian;
  std::size_t at = header.data_offset;
  for (std::size_t i = 0; i < header.vertex; ++i) {
    const auto end = SkipElement(header.elements[i], bytes.view(), swap, at);
    if (!end) {
      throw InputError(
          path,
          "the file ends in the element '" + header.elements[i].name + "' before the vertices",
          "The file is truncated; copy it again.");
    }
    at = *end;
  }
  const PlyElement& vertex = header.elements[header.vertex];
  const std::size_t bytes_there = bytes.size() - at;
  PointTable table = vertex.HasList() ? GatherRows(vertex, bytes.view(), swap, at)
                                      : ViewRows(vertex, std::move(bytes), swap, at);
  NoteMissing(vertex, bytes_there, &table);
  table.undeclared = RowsBehind(header, bytes_there);
  return table;
}

}  // namespace trajlo
