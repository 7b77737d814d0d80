// SPDX-License-Identifier: MIT
#include "core/io/scan_folder.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/io/errors.h"
#include "tests/core/io/io_testing.h"

namespace trajlo {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Five copies of a fixture, 0.1 s apart.
void WriteRecording(const TempFolder& folder, const std::string& fixture, bool stamps) {
  const std::string extension = std::filesystem::path(fixture).extension().string();
  std::string times;
  for (int k = 0; k < 5; ++k) {
    folder.Write("scans/00000" + std::to_string(k) + extension,
                 testing::ReadFile(Fixture(fixture)));
    times += "1600000000." + std::to_string(k) + "\n";
  }
  if (stamps) folder.Write("timestamps.txt", times);
}

std::vector<LidarScan> ReadAll(ScanFolder* recording) {
  std::vector<LidarScan> scans;
  for (LidarScan scan; recording->Next(&scan);) scans.push_back(scan);
  return scans;
}

class EveryFormat : public ::testing::TestWithParam<std::tuple<const char*, bool>> {};

TEST_P(EveryFormat, GivesTheSameScans) {
  const TempFolder folder;
  WriteRecording(folder, std::get<0>(GetParam()), true);
  ScanFolderOptions options;
  options.lidar_id = 3;
  options.read_ahead = std::get<1>(GetParam());
  ScanFolder recording(folder.path(), options);
  EXPECT_EQ(recording.size(), 5U);
  EXPECT_THAT(recording.description(), HasSubstr("stamps: timestamps.txt"));
  const std::vector<LidarScan> scans = ReadAll(&recording);
  ASSERT_EQ(scans.size(), 5U);
  for (std::size_t k = 0; k < scans.size(); ++k) {
    EXPECT_EQ(scans[k].lidar_id, 3);
    EXPECT_EQ(scans[k].stamp_ns, 1600000000000000000 + static_cast<std::int64_t>(k) * 100000000);
    EXPECT_TRUE(scans[k].has_point_times);
    ASSERT_EQ(scans[k].points.size(), 40U);
    for (int i = 0; i < 40; ++i) {
      const LidarPoint& point = scans[k].points[i];
      EXPECT_EQ(point.xyz_m, Eigen::Vector3f(0.25F * i - 4, 10 - 0.5F * i, 0.125F * (i % 8)));
      EXPECT_EQ(point.intensity, i);
      EXPECT_NEAR(static_cast<double>(point.t_ns - scans[k].stamp_ns), 2.5e6 * i, 5);
    }
  }
  EXPECT_EQ(recording.report().scans_read, 5U);
  EXPECT_EQ(recording.report().points_read, 200U);
  EXPECT_FALSE(recording.report().IsPartial());
  EXPECT_THAT(recording.report().warnings, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    Fixtures, EveryFormat,
    ::testing::Combine(::testing::Values("pypcd4_ascii.pcd", "pypcd4_binary.pcd",
                                         "pypcd4_compressed.pcd", "pypcd4_ouster_binary.pcd",
                                         "open3d_compressed.pcd", "numpy_padded.pcd",
                                         "plyfile_ascii.ply", "plyfile_little.ply",
                                         "plyfile_big.ply", "struct_lists_big.ply"),
                       ::testing::Bool()),
    [](const auto& param) {
      std::string name = std::get<0>(param.param);
      for (char& c : name) c = c == '.' ? '_' : c;
      return name + (std::get<1>(param.param) ? "_ahead" : "_serial");
    });

TEST(ScanFolder, WithoutTimesEveryPointGetsTheStamp) {
  const TempFolder folder;
  WriteRecording(folder, "numpy_kitti.bin", false);
  ScanFolder recording(folder.path());
  EXPECT_THAT(recording.description(), HasSubstr("a scan every 100 ms from 0 s is assumed"));
  const auto scans = ReadAll(&recording);
  ASSERT_EQ(scans.size(), 5U);
  EXPECT_EQ(scans[3].stamp_ns, 300000000);
  EXPECT_FALSE(scans[3].has_point_times);
  EXPECT_EQ(scans[3].points[7].t_ns, 300000000);
  EXPECT_THAT(recording.report().warnings, ::testing::Contains(HasSubstr("input.scan_period_s")));
}

TEST(ScanFolder, WithoutStampsMissingNumbersLeaveAGap) {
  const TempFolder folder;
  WriteRecording(folder, "numpy_kitti.bin", false);
  std::filesystem::remove(folder.path() / "scans/000002.bin");
  ScanFolderOptions options;
  options.scan_period_s = 0.2;
  ScanFolder recording(folder.path(), options);
  const auto scans = ReadAll(&recording);
  ASSERT_EQ(scans.size(), 4U);
  EXPECT_EQ(scans[1].stamp_ns, 200000000);
  EXPECT_EQ(scans[2].stamp_ns, 600000000);
  EXPECT_THAT(recording.report().warnings, ::testing::Contains(HasSubstr("1 scan is missing")));
  // Who gave the period needs not be told that one is assumed.
  EXPECT_THAT(recording.report().warnings,
              ::testing::Not(::testing::Contains(HasSubstr("is assumed"))));
}

TEST(ScanFolder, PointTimesCanBeSwitchedOff) {
  const TempFolder folder;
  WriteRecording(folder, "pypcd4_binary.pcd", true);
  ScanFolderOptions options;
  options.time.use_point_times = false;
  ScanFolder recording(folder.path(), options);
  EXPECT_FALSE(ReadAll(&recording).at(0).has_point_times);
}

TEST(ScanFolder, AStampAtTheEndMovesEveryPointBackByASweep) {
  const TempFolder folder;
  WriteRecording(folder, "pypcd4_ouster_binary.pcd", true);
  ScanFolderOptions options;
  options.time.stamp_at = StampAt::kEnd;
  ScanFolder recording(folder.path(), options);
  const auto scans = ReadAll(&recording);
  EXPECT_EQ(scans.at(1).points[0].t_ns, scans.at(1).stamp_ns - 100000000);
  EXPECT_EQ(scans.at(1).points[1].t_ns, scans.at(1).stamp_ns - 97500000);
}

TEST(ScanFolder, AbsoluteTimesGiveTheStampsWhenNothingElseDoes) {
  const TempFolder folder;
  for (int k = 0; k < 3; ++k) {
    std::vector<std::string> rows;
    for (int i = 0; i < 10; ++i) {
      rows.push_back("1 2 3 " + std::to_string(1600000000123456789 + k * 100000000 + i * 10000000));
    }
    folder.Write(std::to_string(k) + ".pcd",
                 AsciiPcd("x y z timestamp", "4 4 4 8", "F F F U", rows));
  }
  ScanFolder recording(folder.path());
  EXPECT_THAT(recording.description(), HasSubstr("stamps: the earliest point of each scan"));
  const auto scans = ReadAll(&recording);
  EXPECT_EQ(scans.at(2).stamp_ns, 1600000000323456789);
  EXPECT_EQ(scans.at(2).points[9].t_ns, 1600000000413456789);
}

TEST(ScanFolder, ANamedTimeFieldThatIsMissingIsAnErrorThatListsTheFields) {
  const TempFolder folder;
  WriteRecording(folder, "pypcd4_binary.pcd", true);
  ScanFolderOptions options;
  options.time.field = "curvature";
  try {
    ScanFolder recording(folder.path(), options);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("'curvature' (input.time_field); the points have: x y z intensity time"));
  }
}

TEST(ScanFolder, DamagedScansAreHandedOnInPartAndUnreadableOnesAreSkipped) {
  const TempFolder folder;
  WriteRecording(folder, "pypcd4_binary.pcd", true);
  const std::string whole = testing::ReadFile(Fixture("pypcd4_binary.pcd"));
  folder.Write("scans/000000.pcd", "");
  folder.Write("scans/000001.pcd", whole.substr(0, whole.size() - 1));
  folder.Write("scans/000004.pcd", whole.substr(0, 50));
  ScanFolder recording(folder.path());
  const auto scans = ReadAll(&recording);
  ASSERT_EQ(scans.size(), 3U);
  EXPECT_EQ(scans[0].stamp_ns, 1600000000100000000);
  EXPECT_EQ(scans[0].points.size(), 39U);
  EXPECT_EQ(scans[1].points.size(), 40U);
  const ReadReport& report = recording.report();
  EXPECT_EQ(report.scans_listed, 5U);
  EXPECT_EQ(report.scans_read, 3U);
  EXPECT_EQ(report.scans_damaged, 1U);
  EXPECT_EQ(report.scans_skipped, 2U);
  EXPECT_TRUE(report.IsPartial());
  EXPECT_THAT(report.warnings, ElementsAre(HasSubstr("000000.pcd"), HasSubstr("000001.pcd"),
                                           HasSubstr("000004.pcd")));
}

TEST(ScanFolder, PointsThatNoHeaderDeclaresAreCountedAndToldOnce) {
  const TempFolder folder;
  WriteRecording(folder, "pypcd4_ascii.pcd", true);
  std::string text = testing::ReadFile(Fixture("pypcd4_ascii.pcd"));
  text.replace(text.find("POINTS 40"), 9, "POINTS 20");
  folder.Write("scans/000002.pcd", text);
  folder.Write("scans/000003.pcd", text);
  ScanFolder recording(folder.path());
  ReadAll(&recording);
  EXPECT_EQ(recording.report().points_read, 160U);
  EXPECT_EQ(recording.report().points_undeclared, 40U);
  EXPECT_EQ(recording.report().scans_damaged, 0U);
  EXPECT_TRUE(recording.report().IsPartial());
  EXPECT_THAT(recording.report().warnings,
              ElementsAre(HasSubstr("000002.pcd: the header declares 20 points, and 20 more")));
}

TEST(ScanFolder, AFileThatVanishesAfterTheStartIsSkipped) {
  const TempFolder folder;
  WriteRecording(folder, "pypcd4_binary.pcd", true);
  ScanFolder recording(folder.path());
  std::filesystem::remove(folder.path() / "scans/000003.pcd");
  EXPECT_EQ(ReadAll(&recording).size(), 4U);
  EXPECT_EQ(recording.report().scans_skipped, 1U);
}

TEST(ScanFolder, AScanWithoutTheTimeFieldIsCountedAsDamaged) {
  const TempFolder folder;
  WriteRecording(folder, "pypcd4_ascii.pcd", true);
  folder.Write("scans/000002.pcd", AsciiPcd("x y z", "4 4 4", "F F F", {"1 2 3"}));
  ScanFolder recording(folder.path());
  const auto scans = ReadAll(&recording);
  ASSERT_EQ(scans.size(), 5U);
  EXPECT_FALSE(scans[2].has_point_times);
  EXPECT_EQ(recording.report().scans_damaged, 1U);
}

TEST(ScanFolder, WhenNoFileCanBeReadTheFirstReasonIsTold) {
  const TempFolder folder;
  folder.Write("0.pcd", "junk");
  folder.Write("1.pcd", "junk");
  try {
    ScanFolder recording(folder.path());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no scan of 2 can be read"));
    EXPECT_THAT(error.what(), HasSubstr("no DATA line"));
  }
}

TEST(ScanFolder, NaNAndEmptyScansPassThrough) {
  const TempFolder folder;
  WriteRecording(folder, "pypcd4_binary_nan.pcd", true);
  folder.Write("scans/000003.pcd",
               "FIELDS x y z intensity time\nSIZE 4 4 4 4 4\nTYPE F F F F F\n"
               "POINTS 0\nDATA binary\n");
  ScanFolder recording(folder.path());
  const auto scans = ReadAll(&recording);
  ASSERT_EQ(scans.size(), 5U);
  EXPECT_TRUE(std::isnan(scans[0].points[5].xyz_m.x()));
  EXPECT_EQ(scans[0].points.size(), 40U);
  EXPECT_TRUE(scans[3].points.empty());
  EXPECT_FALSE(recording.report().IsPartial());
}

TEST(ScanFolder, CanBeLeftInTheMiddle) {
  const TempFolder folder;
  WriteRecording(folder, "pypcd4_binary.pcd", true);
  ScanFolder recording(folder.path());
  LidarScan scan;
  EXPECT_TRUE(recording.Next(&scan));
}

TEST(ScanFolder, SaysNoAgainAndAgainAtTheEnd) {
  const TempFolder folder;
  WriteRecording(folder, "pypcd4_binary.pcd", true);
  ScanFolder recording(folder.path());
  EXPECT_EQ(ReadAll(&recording).size(), 5U);
  LidarScan scan;
  EXPECT_FALSE(recording.Next(&scan));
  EXPECT_FALSE(recording.Next(&scan));
}

TEST(ScanFolder, ALinkToAScanThatIsNotThereIsAScanThatCannotBeRead) {
  const TempFolder folder;
  WriteRecording(folder, "pypcd4_binary.pcd", true);
  std::filesystem::remove(folder.path() / "scans/000002.pcd");
  std::filesystem::create_symlink("/nowhere/000002.pcd", folder.path() / "scans/000002.pcd");
  ScanFolder recording(folder.path());
  EXPECT_EQ(recording.size(), 5U);
  const auto scans = ReadAll(&recording);
  ASSERT_EQ(scans.size(), 4U);
  EXPECT_EQ(scans[2].stamp_ns, 1600000000300000000) << "the stamps stay with their scans";
  EXPECT_EQ(recording.report().scans_skipped, 1U);
  EXPECT_THAT(recording.report().warnings.at(0), HasSubstr("000002.pcd"));
}

TEST(ScanFolder, LeadingScansWithoutPointsDoNotSwitchTheTimesOff) {
  const TempFolder folder;
  WriteRecording(folder, "pypcd4_binary.pcd", false);
  const std::string whole = testing::ReadFile(Fixture("pypcd4_binary.pcd"));
  std::string times;
  for (int k = 0; k < 12; ++k) {
    const std::string name =
        "scans/0000" + std::string(k < 10 ? "0" : "") + std::to_string(k) + ".pcd";
    folder.Write(name,
                 k < 6 ? AsciiPcd("x y z intensity time", "4 4 4 4 4", "F F F F F", {}) : whole);
    times += std::to_string(1600000000 + k) + ".0\n";
  }
  folder.Write("timestamps.txt", times);
  ScanFolder recording(folder.path());
  EXPECT_EQ(recording.time_convention().field, "time");
  EXPECT_TRUE(ReadAll(&recording).at(8).has_point_times);
}

}  // namespace
}  // namespace trajlo
