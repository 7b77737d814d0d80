// SPDX-License-Identifier: MIT
#include "core/report/window_csv.h"

#include <gmock/gmock.h>

#include <clocale>
#include <sstream>

#include "core/io/errors.h"
#include "tests/support/temp_folder.h"

namespace trajlo {
namespace {

using trajlo::testing::ReadFile;
using trajlo::testing::TempFolder;

std::vector<std::vector<std::string>> ReadTable(const std::filesystem::path& path) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(ReadFile(path));
  for (std::string line; std::getline(lines, line);) {
    rows.emplace_back();
    std::istringstream cells(line + ",");
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

std::string Cell(const std::vector<std::vector<std::string>>& table, std::size_t row,
                 const std::string& name) {
  for (std::size_t i = 0; i < table[0].size(); ++i) {
    if (table[0][i] == name) return table[row][i];
  }
  return "no column " + name;
}

TEST(WindowCsv, HasAColumnPerNumberAndExactTimes) {
  const TempFolder temp;
  WindowCsvWriter writer(temp / "windows.csv");
  WindowStatistics window;
  window.index = 3;
  window.begin_ns = 1'700'000'000'030'000'001;
  window.points = 200;
  window.inliers = 150;
  window.smallest_eigenvalue = 0.1;
  window.weak_direction << 0.1, 0, -0.9, 0, 0.2, 0;
  window.milliseconds_map = 0.25;
  window.flags = kFlagGap | kFlagDegenerate;
  writer.Append(window);
  writer.Append(WindowStatistics());

  // Readable before it is closed.
  const auto table = ReadTable(temp / "windows.csv");
  ASSERT_EQ(table.size(), 3u);
  EXPECT_EQ(table[1].size(), table[0].size());
  EXPECT_EQ(table[2].size(), table[0].size());
  EXPECT_EQ(Cell(table, 1, "index"), "3");
  EXPECT_EQ(Cell(table, 1, "begin_s"), "1700000000.030000001");
  EXPECT_EQ(Cell(table, 1, "inlier_share"), "0.75");
  EXPECT_EQ(Cell(table, 1, "smallest_eigenvalue"), "0.1");
  EXPECT_EQ(Cell(table, 1, "weak_rho_z"), "-0.9");
  EXPECT_EQ(Cell(table, 1, "weak_axis"), "z");
  EXPECT_EQ(Cell(table, 1, "map_ms"), "0.25");
  EXPECT_EQ(Cell(table, 1, "flag_names"), "gap|degenerate");
}

TEST(WindowCsv, NamesOfFlagsAndAxes) {
  EXPECT_EQ(FlagNames(0), "");
  EXPECT_EQ(FlagNames(kFlagLost), "lost");
  EXPECT_EQ(AxisName(Vector6d::Zero()), "");
  EXPECT_EQ(AxisName(-Vector6d::Unit(5)), "about_z");
}

TEST(WindowCsv, AFullDiskIsSeenAtOnce) { EXPECT_THROW(WindowCsvWriter("/dev/full"), OutputError); }

TEST(WindowCsv, AnEarlierTableIsNotReplacedWithoutBeingTold) {
  const TempFolder temp;
  WindowCsvWriter(temp / "windows.csv").Close();
  EXPECT_THROW(WindowCsvWriter(temp / "windows.csv"), OutputError);
  EXPECT_NO_THROW(WindowCsvWriter(temp / "windows.csv", IfExists::kReplace));
}

}  // namespace
}  // namespace trajlo
