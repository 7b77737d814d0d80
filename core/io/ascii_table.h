// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/io/point_table.h"

namespace trajlo {

/// One field of a row of text, in the order of the row.
struct AsciiField {
  std::string name;
  ScalarType type = ScalarType::kFloat32;
  /// How many numbers the field has; the first is kept.
  std::size_t repeat = 1;
  /// True for a PLY list: a number n, then n numbers that are skipped. Lists are never kept.
  bool is_list = false;
};

/// Parses up to `declared_count` rows of numbers, one row a line, from `text`.
/// Whole numbers become int64 and all others float64, so that a stamp written out in full keeps
/// all its digits even if the header calls it a float32. A row that cannot be parsed is left out
/// and mentioned in `damage`. If nothing else follows the rows, those behind are `undeclared`.
PointTable ParseAsciiTable(std::string_view text, const std::vector<AsciiField>& fields,
                           std::size_t declared_count, bool are_last);

/// Takes the next line off `text`, without its line end (LF or CRLF).
/// Returns false at the end of the text.
bool TakeLine(std::string_view* text, std::string_view* line);

/// Takes the next word (separated by blanks or tabs) off `line`; empty at the end of the line.
std::string_view TakeWord(std::string_view* line);

}  // namespace trajlo
