// SPDX-License-Identifier: MIT
#include "core/export/csv_table.h"

#include <algorithm>

#include "core/io/errors.h"
#include "core/io/number_text.h"
#include "core/io/random_access_file.h"
#include "core/io/stamp_text.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

std::vector<std::string> Split(std::string_view line) {
  std::vector<std::string> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    cells.emplace_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

CsvTable::CsvTable(const std::filesystem::path& path) : path_(path) {
  const RandomAccessFile file(path);
  const FileBytes bytes = file.Read(0, static_cast<std::size_t>(file.size()));
  std::string_view rest = bytes.view();
  for (std::size_t end = rest.find('\n'); end != rest.npos; end = rest.find('\n')) {
    std::vector<std::string> cells = Split(rest.substr(0, end));
    rest.remove_prefix(end + 1);
    if (names_.empty()) {
      names_ = std::move(cells);
    } else {
      rows_.push_back(std::move(cells));
    }
  }
}

std::size_t CsvTable::ColumnOf(std::string_view name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found != names_.end()) return static_cast<std::size_t>(found - names_.begin());
  throw InputError(path_, "there is no column '" + std::string(name) + "'",
                   "Give a folder that trajlo_run wrote.");
}

std::string_view CsvTable::Text(std::size_t row, std::size_t column) const {
  if (column >= rows_[row].size()) Fail(row, column);
  return rows_[row][column];
}

double CsvTable::Number(std::size_t row, std::size_t column) const {
  double value = 0.0;
  if (!ParseNumber(Text(row, column), &value)) Fail(row, column);
  return value;
}

std::int64_t CsvTable::SecondsAsNs(std::size_t row, std::size_t column) const {
  const auto t_ns = ParseDecimalNs(Text(row, column), kNsPerSecond);
  if (!t_ns) Fail(row, column);
  return *t_ns;
}

void CsvTable::Fail(std::size_t row, std::size_t column) const {
  throw InputError(path_,
                   "line " + std::to_string(row + 2) + " has no valid '" + names_[column] + "'",
                   "Give a folder that trajlo_run wrote.");
}

}  // namespace trajlo
