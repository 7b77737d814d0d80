// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/io/file_bytes.h"

namespace trajlo {

/// The number types that point files hold.
enum class ScalarType : std::uint8_t {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64
};

std::size_t SizeOf(ScalarType type);
bool IsInteger(ScalarType type);
/// "float32", "uint32", ...
const char* NameOf(ScalarType type);

/// Where the values of one field lie: value i is at `offset + i * stride` of the table's bytes.
struct Column {
  std::string name;
  ScalarType type = ScalarType::kFloat32;
  std::size_t offset = 0;
  std::size_t stride = 0;
  bool swap_bytes = false;
};

/// The points of one file as typed columns over its bytes, not yet copied or converted.
/// Rows of a binary PCD or PLY and the columns of a compressed PCD are both described this way.
/// Every column holds `count` values within `bytes`: readers must guarantee it.
struct PointTable {
  FileBytes bytes;
  std::vector<Column> columns;
  std::size_t count = 0;
  /// Points that are there behind those that the header declares, and are not read.
  std::size_t undeclared = 0;
  /// Empty, or a sentence with numbers about what is missing in the file.
  std::string damage;

  /// The first column of that name (ASCII case is ignored), or null.
  const Column* Find(std::string_view name) const;
  /// "x y z intensity", for messages.
  std::string FieldNames() const;
};

/// Makes a name comparable: lower case, and without CloudCompare's prefix "scalar_".
std::string NormalisedFieldName(std::string_view name);

/// Calls `visit(i, value)` for rows [begin, end), the value in the column's own type.
template <typename T, typename Visitor>
void VisitColumnAs(const PointTable& table, const Column& column, std::size_t begin,
                   std::size_t end, Visitor& visit) {
  const char* at = table.bytes.data() + column.offset + begin * column.stride;
  if (!column.swap_bytes) {
    for (std::size_t i = begin; i < end; ++i, at += column.stride) {
      T value;
      std::memcpy(&value, at, sizeof(T));
      visit(i, value);
    }
    return;
  }
  for (std::size_t i = begin; i < end; ++i, at += column.stride) {
    char reversed[sizeof(T)];
    for (std::size_t k = 0; k < sizeof(T); ++k) reversed[k] = at[sizeof(T) - 1 - k];
    T value;
    std::memcpy(&value, reversed, sizeof(T));
    visit(i, value);
  }
}

template <typename Visitor>
void VisitColumn(const PointTable& table, const Column& column, std::size_t begin, std::size_t end,
                 Visitor&& visit) {
  switch (column.type) {
    case ScalarType::kInt8:
      return VisitColumnAs<std::int8_t>(table, column, begin, end, visit);
    case ScalarType::kUint8:
      return VisitColumnAs<std::uint8_t>(table, column, begin, end, visit);
    case ScalarType::kInt16:
      return VisitColumnAs<std::int16_t>(table, column, begin, end, visit);
    case ScalarType::kUint16:
      return VisitColumnAs<std::uint16_t>(table, column, begin, end, visit);
    case ScalarType::kInt32:
      return VisitColumnAs<std::int32_t>(table, column, begin, end, visit);
    case ScalarType::kUint32:
      return VisitColumnAs<std::uint32_t>(table, column, begin, end, visit);
    case ScalarType::kInt64:
      return VisitColumnAs<std::int64_t>(table, column, begin, end, visit);
    case ScalarType::kUint64:
      return VisitColumnAs<std::uint64_t>(table, column, begin, end, visit);
    case ScalarType::kFloat32:
      return VisitColumnAs<float>(table, column, begin, end, visit);
    case ScalarType::kFloat64:
      return VisitColumnAs<double>(table, column, begin, end, visit);
  }
}

}  // namespace trajlo
