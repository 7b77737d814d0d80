// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "core/io/point_table.h"
#include "tests/support/temp_folder.h"

namespace trajlo {

/// One that files are written into in one line.
class TempFolder : public testing::TempFolder {
 public:
  /// Writes a file, with the folders on the way to it.
  std::filesystem::path Write(const std::string& name, const std::string& bytes) const {
    const std::filesystem::path file = path() / name;
    std::filesystem::create_directories(file.parent_path());
    testing::WriteFile(file, bytes);
    return file;
  }
};

inline std::filesystem::path Fixture(const std::string& name) {
  return std::filesystem::path(TRAJLO_TEST_DIR) / "fixtures" / name;
}

/// The folder of real recordings; the environment variable TRAJLO_DATA goes first.
inline std::filesystem::path DataDir() {
  const char* set = std::getenv("TRAJLO_DATA");
  return set != nullptr ? set : TRAJLO_DATA_DIR;
}

/// All values of a column as double.
inline std::vector<double> Values(const PointTable& table, const std::string& name) {
  const Column* column = table.Find(name);
  if (column == nullptr) return {};
  std::vector<double> values(table.count);
  VisitColumn(table, *column, 0, table.count,
              [&](std::size_t i, auto value) { values[i] = static_cast<double>(value); });
  return values;
}

/// Text of a small ascii PCD whose rows are given.
inline std::string AsciiPcd(const std::string& fields, const std::string& sizes,
                            const std::string& types, const std::vector<std::string>& rows) {
  const std::string n = std::to_string(rows.size());
  std::string text = "VERSION 0.7\nFIELDS " + fields + "\nSIZE " + sizes + "\nTYPE " + types +
                     "\nWIDTH " + n + "\nHEIGHT 1\nPOINTS " + n + "\nDATA ascii\n";
  for (const std::string& row : rows) text += row + "\n";
  return text;
}

}  // namespace trajlo
