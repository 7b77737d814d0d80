// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace trajlo {

/// A table as trajlo_run writes it: names in the first line, values without quotes, commas between.
class CsvTable {
 public:
  /// Throws InputError if the file cannot be read. A last line without a line end, as a killed run
  /// leaves it, does not count.
  explicit CsvTable(const std::filesystem::path& path);

  std::size_t rows() const { return rows_.size(); }
  /// The place of a column; throws InputError if there is none of that name.
  std::size_t ColumnOf(std::string_view name) const;
  std::string_view Text(std::size_t row, std::size_t column) const;
  /// These throw InputError, with the line, where the value is none.
  double Number(std::size_t row, std::size_t column) const;
  std::int64_t SecondsAsNs(std::size_t row, std::size_t column) const;

 private:
  [[noreturn]] void Fail(std::size_t row, std::size_t column) const;

  std::filesystem::path path_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace trajlo
