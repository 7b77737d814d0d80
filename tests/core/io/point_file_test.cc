// SPDX-License-Identifier: MIT
// Point files written by other tools (see fixtures/make_fixtures.py) are read to the last number.
#include "core/io/point_file.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "core/io/errors.h"
#include "tests/core/io/io_testing.h"

namespace trajlo {
namespace {

using ::testing::HasSubstr;

/// What a fixture holds besides x, y and z, which are the same in all.
struct Foreign {
  const char* file;
  const char* intensity;
  const char* time;
  /// Time of point i is zero + i * step.
  double zero, step, tolerance;
};

void PrintTo(const Foreign& file, std::ostream* out) { *out << file.file; }

class ForeignFile : public ::testing::TestWithParam<Foreign> {};

TEST_P(ForeignFile, IsReadToTheLastNumber) {
  const Foreign& file = GetParam();
  const PointTable table = ReadPointFile(Fixture(file.file));
  EXPECT_EQ(table.damage, "");
  ASSERT_EQ(table.count, 40U);
  const auto x = Values(table, "x");
  const auto y = Values(table, "y");
  const auto z = Values(table, "z");
  ASSERT_EQ(x.size() + y.size() + z.size(), 120U);
  for (int i = 0; i < 40; ++i) {
    if (!std::isnan(x[i])) {
      EXPECT_EQ(x[i], 0.25 * i - 4);
    }
    EXPECT_EQ(std::isnan(x[i]),
              std::string(file.file).find("_nan") != std::string::npos && i % 5 == 0);
    EXPECT_EQ(y[i], 10 - 0.5 * i);
    EXPECT_EQ(z[i], 0.125 * (i % 8));
  }
  if (file.intensity != nullptr) {
    const auto intensity = Values(table, file.intensity);
    ASSERT_EQ(intensity.size(), 40U);
    for (int i = 0; i < 40; ++i) EXPECT_EQ(intensity[i], i);
  }
  if (file.time != nullptr) {
    const auto time = Values(table, file.time);
    ASSERT_EQ(time.size(), 40U);
    for (int i = 0; i < 40; ++i) EXPECT_NEAR(time[i], file.zero + i * file.step, file.tolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Fixtures, ForeignFile,
    ::testing::Values(
        Foreign{"pypcd4_ascii.pcd", "intensity", "time", 0, 0.0025, 1e-8},
        Foreign{"pypcd4_binary.pcd", "intensity", "time", 0, 0.0025, 1e-8},
        Foreign{"pypcd4_compressed.pcd", "intensity", "time", 0, 0.0025, 1e-8},
        Foreign{"pypcd4_ascii_nan.pcd", "intensity", "time", 0, 0.0025, 1e-8},
        Foreign{"pypcd4_binary_nan.pcd", "intensity", "time", 0, 0.0025, 1e-8},
        Foreign{"pypcd4_compressed_nan.pcd", "intensity", "time", 0, 0.0025, 1e-8},
        Foreign{"pypcd4_ouster_ascii.pcd", "reflectivity", "t", 0, 2.5e6, 0},
        Foreign{"pypcd4_ouster_binary.pcd", "reflectivity", "t", 0, 2.5e6, 0},
        Foreign{"pypcd4_ouster_compressed.pcd", "reflectivity", "t", 0, 2.5e6, 0},
        Foreign{"pypcd4_absolute_ascii.pcd", nullptr, "timestamp", 1.6e9, 0.0025, 2.5e-7},
        Foreign{"pypcd4_absolute_binary.pcd", nullptr, "timestamp", 1.6e9, 0.0025, 2.5e-7},
        Foreign{"pypcd4_absolute_compressed.pcd", nullptr, "timestamp", 1.6e9, 0.0025, 2.5e-7},
        Foreign{"open3d_ascii.pcd", "intensity", "time", 0, 0.0025, 1e-8},
        Foreign{"open3d_binary.pcd", "intensity", "time", 0, 0.0025, 1e-8},
        Foreign{"open3d_compressed.pcd", "intensity", "time", 0, 0.0025, 1e-8},
        Foreign{"open3d_ascii.ply", "intensity", "time", 0, 0.0025, 1e-8},
        Foreign{"open3d_binary.ply", "intensity", "time", 0, 0.0025, 1e-8},
        Foreign{"plyfile_ascii.ply", "intensity", "time", 0, 0.0025, 1e-12},
        Foreign{"plyfile_little.ply", "intensity", "time", 0, 0.0025, 1e-12},
        Foreign{"plyfile_big.ply", "intensity", "time", 0, 0.0025, 1e-12},
        Foreign{"plyfile_lists_ascii.ply", "intensity", "t", 0, 2.5e6, 0},
        Foreign{"plyfile_lists_little.ply", "intensity", "t", 0, 2.5e6, 0},
        Foreign{"struct_lists_big.ply", "intensity", "t", 0, 2.5e6, 0},
        Foreign{"numpy_kitti.bin", "intensity", nullptr, 0, 0, 0},
        Foreign{"numpy_padded.pcd", "intensity", "t", 0, 2.5e6, 0}),
    [](const auto& param) {
      std::string name = param.param.file;
      for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
      return name;
    });

TEST(PointFile, FieldsOfPaddingAreNotOffered) {
  EXPECT_EQ(ReadPointFile(Fixture("numpy_padded.pcd")).FieldNames(), "x y z intensity t ring");
}

TEST(PointFile, NamesAreFoundInAnyCaseAndWithCloudComparesPrefix) {
  const TempFolder folder;
  const auto file =
      folder.Write("a.pcd", AsciiPcd("X Y Z scalar_Intensity", "4 4 4 4", "F F F F", {"1 2 3 4"}));
  const PointTable table = ReadPointFile(file);
  EXPECT_EQ(Values(table, "x"), std::vector<double>{1});
  EXPECT_EQ(Values(table, "intensity"), std::vector<double>{4});
}

TEST(PointFile, WindowsLineEndsTabsPlusSignsAndAMissingLastLineEndAreRead) {
  const TempFolder folder;
  std::string text = AsciiPcd("x y z", "4 4 4", "F F F", {"+1 2\t3", "  4   5 6e0  "});
  text.pop_back();
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) {
    text.replace(at, 1, "\r\n");
  }
  const PointTable table = ReadPointFile(folder.Write("a.pcd", text));
  EXPECT_EQ(table.damage, "");
  EXPECT_EQ(Values(table, "x"), (std::vector<double>{1, 4}));
  EXPECT_EQ(Values(table, "z"), (std::vector<double>{3, 6}));
}

TEST(PointFile, AsciiStampsInNanosecondsKeepEveryDigit) {
  const TempFolder folder;
  const auto file = folder.Write(
      "a.pcd", AsciiPcd("x y z t", "4 4 4 8", "F F F U", {"1 2 3 1600000000123456789"}));
  const PointTable table = ReadPointFile(file);
  VisitColumn(table, *table.Find("t"), 0, 1, [](std::size_t, auto value) {
    EXPECT_EQ(static_cast<std::int64_t>(value), 1600000000123456789);
  });
}

TEST(PointFile, AnAsciiRowThatCannotBeParsedIsLeftOutAndCounted) {
  const TempFolder folder;
  const auto file = folder.Write(
      "a.pcd",
      AsciiPcd("x y z", "4 4 4", "F F F", {"1 2 3", "1 two 3", "1 2", "1 2 3 4", "7 8 9"}));
  const PointTable table = ReadPointFile(file);
  EXPECT_EQ(Values(table, "x"), (std::vector<double>{1, 7}));
  EXPECT_THAT(table.damage, HasSubstr("3 unreadable rows, the first is row 2"));
}

TEST(PointFile, WidthTimesHeightStandsInForAMissingPointsLine) {
  const TempFolder folder;
  const auto file = folder.Write("a.pcd",
                                 "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\n"
                                 "HEIGHT 1\nDATA ascii\n1 2 3\n4 5 6\n");
  EXPECT_EQ(ReadPointFile(file).count, 2U);
}

TEST(PointFile, AnEmptyScanIsNotDamaged) {
  const TempFolder folder;
  for (const char* data : {"ascii", "binary"}) {
    const auto file =
        folder.Write("a.pcd", std::string("FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 0\nDATA ") +
                                  data + "\n");
    const PointTable table = ReadPointFile(file);
    EXPECT_EQ(table.count, 0U);
    EXPECT_EQ(table.damage, "");
  }
  EXPECT_EQ(ReadPointFile(folder.Write("a.bin", "")).count, 0U);
}

/// 320 points of a .bin: x, y, z, an intensity, and then what `more` says of point i.
template <typename More>
std::string Bin(const More& more) {
  std::string bytes;
  for (int i = 0; i < 320; ++i) {
    std::vector<float> row = {0.25F * static_cast<float>(i) + 0.1F, -3.3F, 1.7F,
                              static_cast<float>(i % 90)};
    for (const float value : more(i)) row.push_back(value);
    bytes.append(reinterpret_cast<const char*>(row.data()), sizeof(float) * row.size());
  }
  return bytes;
}

float Ring(int i) { return static_cast<float>(i % 32); }
float Time(int i) { return 1e-4F * static_cast<float>(i); }

TEST(PointFile, ABinWithFiveNumbersAPointIsToldByItsRings) {
  const TempFolder folder;
  std::string bytes = Bin([](int i) { return std::vector{Ring(i)}; });
  const PointTable table = ReadPointFile(folder.Write("n015__LIDAR_TOP.pcd.bin", bytes));
  EXPECT_EQ(table.FieldNames(), "x y z intensity ring");
  EXPECT_EQ(table.count, 320U);
  EXPECT_EQ(table.damage, "");
  EXPECT_NEAR(Values(table, "x")[319], 79.85, 1e-4);
  EXPECT_EQ(Values(table, "ring")[33], 1.0);
  const PointTable cut = ReadPointFile(folder.Write("cut.pcd.bin", bytes.substr(0, 20 * 319 + 13)));
  EXPECT_EQ(cut.FieldNames(), "x y z intensity ring");
  EXPECT_EQ(cut.count, 319U);
  EXPECT_THAT(cut.damage, HasSubstr("319 points of 20 bytes and a rest of 13"));
  // A number that is not finite among the rings changes nothing.
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::string spoilt = bytes;
  spoilt.replace(20 * 7 + 16, sizeof(nan), reinterpret_cast<const char*>(&nan), sizeof(nan));
  EXPECT_EQ(ReadPointFile(folder.Write("nan.bin", spoilt)).FieldNames(), "x y z intensity ring");
}

std::string Refusal(const std::filesystem::path& file) {
  try {
    return "read as " + ReadPointFile(file).FieldNames();
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(PointFile, ABinWhoseIntensitiesWouldBeCoordinatesIsRefused) {
  const TempFolder folder;
  const std::string five = Bin([](int i) { return std::vector{Time(i)}; });
  EXPECT_THAT(Refusal(folder.Write("xyzit.bin", five)), HasSubstr(" 5 numbers a point"));
  std::string three;
  for (std::size_t i = 0; i < 319; ++i) three += five.substr(20 * i, 12);
  EXPECT_THAT(Refusal(folder.Write("xyz.bin", three)), HasSubstr(" 3 numbers a point"));
  // Four that fill rows of three and five, too; -1 where the intensity is unknown.
  std::string four;
  const float unknown = -1.0F;
  for (std::size_t i = 0; i < 300; ++i) {
    four += five.substr(20 * i, 12);
    four.append(reinterpret_cast<const char*>(&unknown), sizeof(unknown));
  }
  EXPECT_EQ(Refusal(folder.Write("xyzi.bin", four)), "read as x y z intensity");
}

TEST(PointFile, ABinWithMoreNumbersAPointIsRefused) {
  const TempFolder folder;
  try {
    ReadPointFile(folder.Write("six.bin", Bin([](int i) {
                                 return std::vector{Ring(i), Time(i)};
                               })));
    FAIL() << "rings and times were taken for coordinates";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("6 numbers a point"));
  }
  const auto file = folder.Write("eight.bin", Bin([](int i) {
                                   return std::vector{Time(i), Ring(i), 0.0F, 0.0F};
                                 }));
  EXPECT_THROW(ReadPointFile(file), InputError);
}

TEST(PointFile, BinaryDataThatIsNoScanIsRefusedAsKittiBin) {
  const TempFolder folder;
  std::string packets;
  for (int i = 0; i < 16000; ++i) packets += static_cast<char>(i * 7919 >> 3);
  try {
    ReadPointFile(folder.Write("packets.bin", packets));
    FAIL() << "packets were taken for points";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("cannot be metres"));
  }
}

}  // namespace
}  // namespace trajlo
