// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/point_table.h"

namespace trajlo {

struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::kFloat32;
  /// A list holds a count of type `count_type`, then that many values of `type`.
  bool is_list = false;
  ScalarType count_type = ScalarType::kUint8;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  bool HasList() const;
  /// Bytes of one row in a binary file; only for elements without lists.
  std::size_t RowBytes() const;
};

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  /// The element "vertex"; the elements before it must be skipped.
  std::size_t vertex = 0;
  std::size_t data_offset = 0;
};

/// Throws InputError (naming `path`) on anything that is not a PLY header with a vertex element.
PlyHeader ParsePlyHeader(const std::filesystem::path& path, std::string_view file);

}  // namespace trajlo
