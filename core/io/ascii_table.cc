// SPDX-License-Identifier: MIT
#include "core/io/ascii_table.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "core/io/format_text.h"

namespace trajlo {
namespace {

bool ParseDouble(std::string_view word, double* value) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, *value);
  if (error == std::errc::result_out_of_range) {
    *value = std::numeric_limits<double>::quiet_NaN();
    return true;
  }
  return error == std::errc() && stop == end;
}

bool ParseInteger(std::string_view word, std::int64_t* value) {
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, *value);
  if (error == std::errc() && stop == end) return true;
  double number = 0.0;  // Some tools print integer fields as "12.0".
  if (!ParseDouble(word, &number) || !(number > -9e18 && number < 9e18)) return false;
  *value = static_cast<std::int64_t>(number);
  return true;
}

/// Parses one value into the 8 bytes at `out`.
bool ParseValue(std::string_view word, ScalarType type, char* out) {
  if (word.empty()) return false;
  if (IsInteger(type)) {
    std::int64_t value = 0;
    if (!ParseInteger(word, &value)) return false;
    std::memcpy(out, &value, sizeof(value));
    return true;
  }
  double value = 0.0;
  if (!ParseDouble(word, &value)) return false;
  std::memcpy(out, &value, sizeof(value));
  return true;
}

bool SkipWords(std::string_view* line, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (TakeWord(line).empty()) return false;
  }
  return true;
}

bool IsBlank(std::string_view line) {
  return line.find_first_not_of(" \t\r") == std::string_view::npos;
}

/// Parses one row into consecutive 8-byte values at `out`.
bool ParseRow(std::string_view line, const std::vector<AsciiField>& fields, char* out) {
  for (const AsciiField& field : fields) {
    if (field.is_list) {
      std::int64_t length = 0;
      const std::string_view word = TakeWord(&line);
      if (word.empty() || !ParseInteger(word, &length) || length < 0) return false;
      if (!SkipWords(&line, static_cast<std::size_t>(length))) return false;
      continue;
    }
    if (field.repeat == 0) continue;
    if (!ParseValue(TakeWord(&line), field.type, out)) return false;
    if (!SkipWords(&line, field.repeat - 1)) return false;
    out += sizeof(double);
  }
  return TakeWord(&line).empty();
}

bool IsKept(const AsciiField& field) { return !field.is_list && field.repeat > 0; }

}  // namespace

bool TakeLine(std::string_view* text, std::string_view* line) {
  if (text->empty()) return false;
  const std::size_t end = text->find('\n');
  *line = text->substr(0, end);
  text->remove_prefix(end == std::string_view::npos ? text->size() : end + 1);
  if (!line->empty() && line->back() == '\r') line->remove_suffix(1);
  return true;
}

std::string_view TakeWord(std::string_view* line) {
  const std::size_t begin = line->find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) {
    *line = {};
    return {};
  }
  line->remove_prefix(begin);
  const std::size_t end = std::min(line->find_first_of(" \t\r"), line->size());
  const std::string_view word = line->substr(0, end);
  line->remove_prefix(end);
  return word;
}

PointTable ParseAsciiTable(std::string_view text, const std::vector<AsciiField>& fields,
                           std::size_t declared_count, bool are_last) {
  PointTable table;
  const auto kept = static_cast<std::size_t>(std::count_if(fields.begin(), fields.end(), IsKept));
  const std::size_t stride = kept * sizeof(double);
  for (const AsciiField& field : fields) {
    if (!IsKept(field)) continue;
    const ScalarType type = IsInteger(field.type) ? ScalarType::kInt64 : ScalarType::kFloat64;
    table.columns.push_back(
        {field.name, type, table.columns.size() * sizeof(double), stride, false});
  }
  // A value takes two characters at least: a header that claims more rows is not believed.
  const std::size_t possible = kept == 0 ? 0 : text.size() / (2 * kept) + 1;
  table.bytes = FileBytes(std::min(declared_count, possible) * stride);

  std::size_t bad_rows = 0;
  std::size_t first_bad_row = 0;
  std::size_t row = 0;
  std::string_view line;
  while (row < declared_count && kept > 0 && TakeLine(&text, &line)) {
    if (IsBlank(line)) continue;
    if (table.count * stride + stride > table.bytes.size()) break;
    if (ParseRow(line, fields, table.bytes.data() + table.count * stride)) {
      ++table.count;
    } else if (bad_rows++ == 0) {
      first_bad_row = row + 1;
    }
    ++row;
  }
  table.bytes.Shrink(table.count * stride);
  while (are_last && row == declared_count && TakeLine(&text, &line)) {
    table.undeclared += IsBlank(line) ? 0 : 1;
  }
  if (table.count < declared_count) {
    table.damage = std::to_string(declared_count) + " points declared, " +
                   std::to_string(table.count) + " readable";
    if (bad_rows > 0) {
      table.damage += ", " + CountOf(bad_rows, "unreadable row") + ", the first is row " +
                      std::to_string(first_bad_row);
    }
  }
  return table;
}

}  // namespace trajlo
