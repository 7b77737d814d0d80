// SPDX-License-Identifier: MIT
#include "core/io/scan_decoder.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <vector>

namespace trajlo {
namespace {

/// A table of doubles with the columns x, y, z, t.
PointTable TableOf(const std::vector<std::array<double, 4>>& rows) {
  PointTable table;
  table.count = rows.size();
  table.bytes = FileBytes(rows.size() * sizeof(rows[0]));
  std::memcpy(table.bytes.data(), rows.data(), table.bytes.size());
  std::size_t offset = 0;
  for (const char* name : {"x", "y", "z", "t"}) {
    table.columns.push_back({name, ScalarType::kFloat64, offset, sizeof(rows[0]), false});
    offset += sizeof(double);
  }
  return table;
}

TEST(ScanDecoder, PointsWithoutAReturnAreNoEvidence) {
  const PointTable table =
      TableOf({{0, 0, 0, -77}, {NAN, 1, 1, -88}, {1, 2, 3, 0.01}, {1, 2, 3, NAN}, {1, 2, 3, 0.05}});
  const auto sample = SampleTimes(table, *table.Find("t"));
  ASSERT_TRUE(sample.has_value());
  EXPECT_EQ(sample->first, 0.01);
  EXPECT_EQ(sample->last, 0.05);
}

TEST(ScanDecoder, AFewWrongTimesAreNoEvidence) {
  std::vector<std::array<double, 4>> rows;
  for (int i = 0; i < 100; ++i) rows.push_back({1, 2, 3, 0.001 * i});
  for (const double wrong : {1e12, -77.0, 3.4e38}) {
    rows[50][3] = wrong;
    const PointTable table = TableOf(rows);
    const auto sample = SampleTimes(table, *table.Find("t"));
    ASSERT_TRUE(sample.has_value());
    EXPECT_EQ(sample->first, 0.0);
    EXPECT_EQ(sample->last, 0.099);
    EXPECT_EQ(sample->points, 100U);
  }
}

TEST(ScanDecoder, AbsoluteTimesDoNotNeedARightStamp) {
  TimeConvention convention;
  convention.field = "t";
  convention.origin = TimeOrigin::kAbsolute;
  convention.sweep_ns = 100'000'000;
  LidarScan scan;
  const auto table = TableOf({{1, 2, 3, 1.6e9}, {1, 2, 3, 5.0}, {1, 2, 3, 1.6e9 + 0.0625}});
  EXPECT_EQ(DecodeScan("a.pcd", table, convention, 86'400'000'000'000, &scan), 1U);
  EXPECT_EQ(scan.points[0].t_ns, 1'600'000'000'000'000'000);
  EXPECT_EQ(scan.points[2].t_ns, 1'600'000'000'062'500'000);
  EXPECT_TRUE(std::isnan(scan.points[1].xyz_m.x()));
}

TEST(ScanDecoder, APointWithAnImpossibleTimeIsDisarmedAndCounted) {
  TimeConvention convention;
  convention.field = "t";
  convention.sweep_ns = 100'000'000;
  LidarScan scan;
  const std::size_t broken = DecodeScan(
      "a.pcd", TableOf({{1, 2, 3, 0.05}, {1, 2, 3, NAN}, {1, 2, 3, 1e30}, {1, 2, 3, -86400}}),
      convention, 7'000'000'000, &scan);
  EXPECT_EQ(broken, 3U);
  EXPECT_EQ(scan.points[0].t_ns, 7'050'000'000);
  EXPECT_TRUE(scan.points[0].xyz_m.allFinite());
  for (int i = 1; i < 4; ++i) {
    EXPECT_EQ(scan.points[i].t_ns, scan.stamp_ns);
    EXPECT_TRUE(std::isnan(scan.points[i].xyz_m.x()));
  }
}

TEST(ScanDecoder, PointsThatAreNaNKeepTheirTime) {
  TimeConvention convention;
  convention.field = "t";
  convention.sweep_ns = 100'000'000;
  LidarScan scan;
  EXPECT_EQ(DecodeScan("a.pcd", TableOf({{NAN, NAN, NAN, 0.05}}), convention, 0, &scan), 0U);
  EXPECT_EQ(scan.points.at(0).t_ns, 50'000'000);
}

TEST(ScanDecoder, AbsoluteDoubleSecondsLoseNothingBeyondTheDouble) {
  TimeConvention convention;
  convention.field = "t";
  convention.origin = TimeOrigin::kAbsolute;
  convention.sweep_ns = 100'000'000;
  LidarScan scan;
  // 1.6e9 + 1/1024 is exact in a double.
  DecodeScan("a.pcd", TableOf({{1, 2, 3, 1.6e9 + 1.0 / 1024}, {1, 2, 3, 1.6e9}}), convention, {},
             &scan);
  EXPECT_EQ(scan.points[0].t_ns, 1'600'000'000'000'976'563);
  EXPECT_EQ(scan.stamp_ns, 1'600'000'000'000'000'000);
}

TEST(ScanDecoder, OneBrokenEarlyTimeDoesNotMoveTheStamp) {
  TimeConvention convention;
  convention.field = "t";
  convention.origin = TimeOrigin::kAbsolute;
  convention.sweep_ns = 100'000'000;
  LidarScan scan;
  EXPECT_EQ(
      DecodeScan("a.pcd", TableOf({{1, 2, 3, 0}, {1, 2, 3, 1.6e9}, {1, 2, 3, 1.6e9 + 0.0625}}),
                 convention, {}, &scan),
      1U);
  EXPECT_EQ(scan.stamp_ns, 1'600'000'000'000'000'000);
}

}  // namespace
}  // namespace trajlo
