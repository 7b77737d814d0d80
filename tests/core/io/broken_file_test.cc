// SPDX-License-Identifier: MIT
// Files that end too early, at every byte: no crash, no hang, never more points than there were.
#include <gmock/gmock.h>

#include "core/io/errors.h"
#include "core/io/pcd_reader.h"
#include "core/io/ply_reader.h"
#include "core/io/point_file.h"
#include "core/io/scan_decoder.h"
#include "tests/core/io/io_testing.h"

namespace trajlo {
namespace {

using ::testing::HasSubstr;

class CutFile : public ::testing::TestWithParam<const char*> {};

TEST_P(CutFile, GivesAPrefixOfItsPointsOrAnErrorAtEveryByte) {
  const TempFolder folder;
  const std::string whole = testing::ReadFile(Fixture(GetParam()));
  const std::string name = "cut" + std::filesystem::path(GetParam()).extension().string();
  const bool compressed = std::string(GetParam()).find("compressed") != std::string::npos;
  std::size_t previous = 0;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const auto file = folder.Write(name, whole.substr(0, size));
    try {
      const PointTable table = ReadPointFile(file);
      ASSERT_LE(table.count, 40U) << size;
      ASSERT_GE(table.count, previous) << "fewer points in a longer file, " << size;
      previous = table.count;
      LidarScan scan;
      DecodeScan(file, table, {}, 0, &scan);
      ASSERT_EQ(scan.points.size(), table.count);
      for (std::size_t i = 0; i < table.count && !compressed; ++i) {
        // All but the last point of a text file, whose last number may be cut.
        if (i + 1 < table.count) {
          ASSERT_EQ(scan.points[i].xyz_m.y(), 10 - 0.5F * i) << size;
        }
      }
    } catch (const InputError& error) {
      ASSERT_EQ(previous, 0U) << "points are lost in a longer file, " << size;
      ASSERT_THAT(error.what(), HasSubstr(file.string()));
    }
  }
  if (!compressed) {
    EXPECT_GE(previous, 38U);
  }
}

INSTANTIATE_TEST_SUITE_P(Fixtures, CutFile,
                         ::testing::Values("pypcd4_ascii.pcd", "pypcd4_binary.pcd",
                                           "pypcd4_compressed.pcd", "numpy_padded.pcd",
                                           "plyfile_ascii.ply", "plyfile_little.ply",
                                           "plyfile_big.ply", "plyfile_lists_ascii.ply",
                                           "plyfile_lists_little.ply", "numpy_kitti.bin"),
                         [](const auto& param) {
                           std::string name = param.param;
                           for (char& c : name) c = c == '.' ? '_' : c;
                           return name;
                         });

TEST(BrokenFile, ATruncatedBinaryPcdSaysWhatIsMissing) {
  const TempFolder folder;
  const std::string whole = testing::ReadFile(Fixture("pypcd4_binary.pcd"));
  const PointTable table = ReadPointFile(folder.Write("a.pcd", whole.substr(0, whole.size() - 30)));
  EXPECT_EQ(table.count, 38U);
  EXPECT_THAT(table.damage, HasSubstr("POINTS 40 of 20 bytes declared, 770 bytes (38 points)"));
}

TEST(BrokenFile, ATruncatedPlySaysWhatIsMissing) {
  const TempFolder folder;
  const std::string whole = testing::ReadFile(Fixture("plyfile_little.ply"));
  const PointTable table = ReadPointFile(folder.Write("a.ply", whole.substr(0, whole.size() - 1)));
  EXPECT_EQ(table.count, 39U);
  EXPECT_THAT(table.damage, HasSubstr("40 vertices declared, 39 whole ones"));
}

TEST(BrokenFile, PointsBehindThoseThatTheHeaderDeclaresAreCounted) {
  const TempFolder folder;
  const auto half_of = [&](const std::string& fixture, const std::string& count) {
    std::string text = testing::ReadFile(Fixture(fixture));
    text.replace(text.find(count + " 40") + count.size(), 3, " 20");
    return ReadPointFile(folder.Write("half" + fixture.substr(fixture.size() - 4), text));
  };
  for (const auto& [fixture, count] :
       std::vector<std::pair<std::string, std::string>>{{"pypcd4_ascii.pcd", "POINTS"},
                                                        {"plyfile_ascii.ply", "vertex"},
                                                        {"plyfile_little.ply", "vertex"},
                                                        {"plyfile_big.ply", "vertex"}}) {
    EXPECT_EQ(ReadPointFile(Fixture(fixture)).undeclared, 0U) << fixture;
    const PointTable table = half_of(fixture, count);
    EXPECT_EQ(table.count, 20U) << fixture;
    EXPECT_EQ(table.undeclared, 20U) << fixture;
    EXPECT_EQ(table.damage, "") << fixture;
  }
}

TEST(BrokenFile, ATruncatedKittiBinSaysHowMuchIsLeftOver) {
  const TempFolder folder;
  const std::string whole = testing::ReadFile(Fixture("numpy_kitti.bin"));
  const PointTable table = ReadPointFile(folder.Write("a.bin", whole.substr(0, whole.size() - 5)));
  EXPECT_EQ(table.count, 39U);
  EXPECT_THAT(table.damage, HasSubstr("a rest of 11"));
}

TEST(BrokenFile, AHeaderThatClaimsMoreThanTheFileHoldsAllocatesNoMoreThanTheFile) {
  const TempFolder folder;
  for (const std::string data : {"ascii", "binary", "binary_compressed"}) {
    for (const std::string points : {"1000000000", "1099511627776", "18446744073709551615", "-1"}) {
      const auto file =
          folder.Write("a.pcd", "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 9\nPOINTS " + points +
                                    "\nDATA " + data + "\n1 2 3\n4 5 6\n");
      try {
        const PointTable table = ReadPointFile(file);
        EXPECT_LE(table.count, 2U);
        EXPECT_LE(table.bytes.size(), 500U);
        EXPECT_NE(table.damage, "");
      } catch (const InputError&) {
      }
    }
  }
  const auto file =
      folder.Write("a.ply",
                   "ply\nformat binary_little_endian 1.0\nelement vertex 999999999999\n"
                   "property list uchar float e\nproperty float x\nend_header\n\1");
  EXPECT_LE(ReadPointFile(file).bytes.size(), 100U);
}

TEST(BrokenFile, HugeFieldsCannotOverflowTheSizeOfAPoint) {
  const TempFolder folder;
  std::string names = "x y z", sizes = "4 4 4", types = "F F F", counts = "1 1 1";
  for (int i = 0; i < 64; ++i) {
    names += " f" + std::to_string(i);
    sizes += " 8";
    types += " F";
    counts += " 65536";
  }
  const auto file = folder.Write(
      "a.pcd", "FIELDS " + names + "\nSIZE " + sizes + "\nTYPE " + types + "\nCOUNT " + counts +
                   "\nPOINTS 1099511627776\nDATA binary_compressed\n" + std::string(8, '\0'));
  EXPECT_THROW(ReadPointFile(file), InputError);
}

TEST(BrokenFile, ErrorsNameTheFileTheFindingAndTheMend) {
  const TempFolder folder;
  const auto message = [&](const std::string& name, const std::string& bytes) -> std::string {
    try {
      const auto file = folder.Write(name, bytes);
      LidarScan scan;
      DecodeScan(file, ReadPointFile(file), {}, 0, &scan);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message("a.pcd", "FIELDS x y\nSIZE 4\nTYPE F F\nPOINTS 1\nDATA ascii\n"),
              HasSubstr("2 FIELDS, but 1 SIZE"));
  EXPECT_THAT(message("b.pcd", "FIELDS x\nSIZE 3\nTYPE F\nPOINTS 1\nDATA ascii\n"),
              HasSubstr("field 'x'"));
  EXPECT_THAT(message("c.pcd", "FIELDS x\nSIZE 4\nTYPE F\nPOINTS 1\nDATA zip\n"),
              HasSubstr("'zip'"));
  EXPECT_THAT(message("d.pcd", "nothing"), HasSubstr("no DATA line"));
  EXPECT_THAT(message("e.ply", "nothing"), HasSubstr("not 'ply'"));
  EXPECT_THAT(message("f.ply", "ply\nformat ascii 1.0\nelement face 1\nend_header\n"),
              HasSubstr("no element named vertex"));
  EXPECT_THAT(message("g.pcd", AsciiPcd("a b c", "4 4 4", "F F F", {"1 2 3"})),
              HasSubstr("x, y and z, but this file has: a b c"));
  EXPECT_THAT(message("h.pcd", "FIELDS x\nSIZE 4\nTYPE F\nPOINTS 1\nDATA binary_compressed\n123"),
              HasSubstr("its two sizes are cut off"));
}

}  // namespace
}  // namespace trajlo
