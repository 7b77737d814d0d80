// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <clocale>
#include <cmath>

#include "core/io/atomic_file.h"
#include "core/io/errors.h"
#include "core/io/point_cloud_writer.h"
#include "core/io/point_file.h"
#include "core/io/trajectory_reader.h"
#include "core/io/trajectory_writer.h"
#include "tests/core/io/io_testing.h"

namespace trajlo {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const SE3 kPose(Eigen::Quaterniond(0.5, -0.5, 0.5, 0.5), Eigen::Vector3d(1.25, -2.5, 1e-10));

bool HasFullDevice() { return std::filesystem::exists("/dev/full"); }

TEST(TumWriter, PrintsStampsExactlyAndNineDecimals) {
  const TempFolder folder;
  TumWriter writer(folder.path() / "a.tum");
  writer.Append(1600000000123456789, kPose);
  writer.Append(-1, SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(-1e-12, 1e6, 0.1)));
  writer.Close();
  EXPECT_EQ(testing::ReadFile(folder.path() / "a.tum"),
            "1600000000.123456789 1.250000000 -2.500000000 0.000000000 "
            "-0.500000000 0.500000000 0.500000000 0.500000000\n"
            "-0.000000001 0.000000000 1000000.000000000 0.100000000 "
            "0.000000000 0.000000000 0.000000000 1.000000000\n");
}

TEST(TumWriter, EveryPoseIsInTheFileBeforeTheNextCall) {
  const TempFolder folder;
  TumWriter writer(folder.path() / "a.tum");
  for (std::size_t i = 1; i < 5; ++i) {
    writer.Append(static_cast<std::int64_t>(i), kPose);
    EXPECT_EQ(ReadTum(folder.path() / "a.tum").size(), i);
  }
  writer.Flush();
}

TEST(TumWriter, WhatItWritesReadsBack) {
  const TempFolder folder;
  TumWriter writer(folder.path() / "a.tum");
  for (int i = 0; i < 100; ++i) {
    Vector6d tau = Vector6d::Constant(0.03 * i);
    writer.Append(1600000000000000000 + i * 33333333LL, se3::Exp(tau));
  }
  writer.Close();
  const auto poses = ReadTum(folder.path() / "a.tum");
  ASSERT_EQ(poses.size(), 100U);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(poses[i].t_ns, 1600000000000000000 + i * 33333333LL);
    EXPECT_LT(Minus(poses[i].T_world_body, se3::Exp(Vector6d::Constant(0.03 * i))).norm(), 1e-8);
  }
}

TEST(TumWriter, NumbersDoNotFollowTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) GTEST_SKIP() << "no German locale here";
  const TempFolder folder;
  TumWriter writer(folder.path() / "a.tum");
  writer.Append(0, kPose);
  std::setlocale(LC_ALL, before.c_str());
  EXPECT_THAT(testing::ReadFile(folder.path() / "a.tum"), HasSubstr("1.250000000"));
}

TEST(TumWriter, AFullDiskIsAnErrorAtTheWrite) {
  if (!HasFullDevice()) GTEST_SKIP() << "no /dev/full on this system";
  TumWriter writer("/dev/full");
  EXPECT_THROW(writer.Append(0, kPose), OutputError);
}

TEST(TumWriter, AnEarlierResultIsNotReplacedUnlessToldSo) {
  const TempFolder folder;
  const auto file = folder.Write("a.tum", "precious\n");
  EXPECT_THROW(TumWriter writer(file), OutputError);
  EXPECT_EQ(testing::ReadFile(file), "precious\n");
  TumWriter writer(file, IfExists::kReplace);
  writer.Append(0, kPose);
  EXPECT_EQ(ReadTum(file).size(), 1U);
}

TEST(TumWriter, AMissingFolderIsAnErrorThatNamesTheFile) {
  const TempFolder folder;
  try {
    TumWriter writer(folder.path() / "no" / "a.tum");
    FAIL();
  } catch (const OutputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no/a.tum"));
  }
}

TEST(TumWriter, WritingAfterCloseIsAnError) {
  const TempFolder folder;
  TumWriter writer(folder.path() / "a.tum");
  writer.Close();
  writer.Close();
  EXPECT_THROW(writer.Append(0, kPose), OutputError);
}

TEST(KittiWriter, WritesTheRowsOfTheMatrix) {
  const TempFolder folder;
  KittiWriter writer(folder.path() / "a.txt");
  writer.Append(SE3(Eigen::Quaterniond(0, 0, 0, 1), Eigen::Vector3d(1, 2, -3)));
  writer.Close();
  std::ifstream file(folder.path() / "a.txt");
  std::vector<double> values(std::istream_iterator<double>(file), {});
  EXPECT_THAT(values, ElementsAre(-1, 0, 0, 1, 0, -1, 0, 2, 0, 0, 1, -3));
}

TEST(ReadTum, SkipsCommentsBlankLinesAndABrokenLastLine) {
  const TempFolder folder;
  std::vector<std::string> warnings;
  const auto poses = ReadTum(folder.Write("a.tum",
                                          "\xEF\xBB\xBF# a comment\r\n\r\n"
                                          "1.5e0\t1 2 3  0 0 0 2\r\n"
                                          "2 1 2 nan 0 0 0 1\n"
                                          "3 1 2 3 0 0 0 0\n"
                                          "4 1 2 3 0 0"),
                             &warnings);
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses[0].t_ns, 1500000000);
  EXPECT_EQ(poses[0].T_world_body.q.w(), 1.0);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("line 4"), HasSubstr("line 6"), HasSubstr("line 5")));
}

TEST(ReadTum, PositionsOfATotalStationHaveNoRotations) {
  const TempFolder folder;
  std::vector<std::string> warnings;
  const auto poses =
      ReadTum(folder.Write("a.tum", "1 1 2 3 0 0 0 0\n2 4 5 6 0 0 0 0\n"), &warnings);
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[1].T_world_body.t, Eigen::Vector3d(4, 5, 6));
  EXPECT_TRUE(poses[1].T_world_body.q.isApprox(Eigen::Quaterniond::Identity()));
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("without rotations")));
}

TEST(ReadTum, AWrongNumberOfColumnsOrTextIsAnErrorThatNamesTheLine) {
  const TempFolder folder;
  for (const std::string line :
       {"1 1 2 3 0 0 0", "1 1 2 3 0 0 0 1 9", "1 a 2 3 0 0 0 1", "x 1 2 3 0 0 0 1"}) {
    try {
      ReadTum(folder.Write("a.tum", "0 1 2 3 0 0 0 1\n" + line + "\n2 1 2 3 0 0 0 1\n"));
      FAIL() << line;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("line 2"));
    }
  }
}

class CloudWriter : public ::testing::TestWithParam<std::tuple<const char*, CloudFields>> {};

TEST_P(CloudWriter, WhatItWritesReadsBackToTheLastBit) {
  const TempFolder folder;
  const auto file = folder.path() / std::get<0>(GetParam());
  std::vector<CloudPoint> points;
  for (int i = 0; i < 20000; ++i)
    points.push_back({Eigen::Vector3f(0.1F * i, -i, 1.0F / (1 + i)), 2.0F * i});
  WritePointCloud(file, points, std::get<1>(GetParam()));
  const PointTable table = ReadPointFile(file);
  EXPECT_EQ(table.damage, "");
  ASSERT_EQ(table.count, points.size());
  const auto x = Values(table, "x");
  const auto z = Values(table, "z");
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_EQ(x[i], points[i].xyz_m.x());
    ASSERT_EQ(z[i], points[i].xyz_m.z());
  }
  const bool intensity = std::get<1>(GetParam()) == CloudFields::kXyzIntensity;
  EXPECT_EQ(table.Find("intensity") != nullptr, intensity);
  if (intensity) {
    EXPECT_EQ(Values(table, "intensity")[9], 18.0);
  }
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
}

INSTANTIATE_TEST_SUITE_P(Formats, CloudWriter,
                         ::testing::Combine(::testing::Values("map.pcd", "map.ply"),
                                            ::testing::Values(CloudFields::kXyz,
                                                              CloudFields::kXyzIntensity)));

TEST(PointCloudWriter, AnEmptyCloudIsAFileToo) {
  const TempFolder folder;
  WritePointCloud(folder.path() / "map.ply", {});
  EXPECT_EQ(ReadPointFile(folder.path() / "map.ply").count, 0U);
}

TEST(PointCloudWriter, AFullDiskIsAnError) {
  if (!HasFullDevice()) GTEST_SKIP() << "no /dev/full on this system";
  const TempFolder folder;
  const auto link = folder.path() / "map.pcd";
  std::filesystem::create_symlink("/dev/full", link);
  EXPECT_THROW(WritePointCloud(link, {CloudPoint{}}), OutputError);
  EXPECT_TRUE(std::filesystem::exists("/dev/full"));
}

TEST(PointCloudWriter, AnUnknownExtensionIsAnError) {
  const TempFolder folder;
  EXPECT_THROW(WritePointCloud(folder.path() / "map.las", {}), OutputError);
}

TEST(AtomicFile, AppearsOnlyWhenItIsCommitted) {
  const TempFolder folder;
  const auto path = folder.path() / "summary.json";
  {
    AtomicFile file(path);
    file.Write("{}");
    EXPECT_FALSE(std::filesystem::exists(path));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  AtomicFile file(path);
  file.Write("{}");
  file.Commit();
  EXPECT_EQ(testing::ReadFile(path), "{}");
}

TEST(AtomicFile, KeepsTheOldFileUntilTheNewOneIsComplete) {
  const TempFolder folder;
  const auto path = folder.Write("a.txt", "old");
  EXPECT_THROW(WriteTextFile(path, "new"), OutputError);
  EXPECT_EQ(testing::ReadFile(path), "old");
  WriteTextFile(path, "new", IfExists::kReplace);
  EXPECT_EQ(testing::ReadFile(path), "new");
}

TEST(AtomicFile, AFileMadeInTheMeantimeIsNotReplaced) {
  const TempFolder folder;
  AtomicFile file(folder.path() / "a.txt");
  file.Write("mine");
  folder.Write("a.txt", "theirs");
  EXPECT_THROW(file.Commit(), OutputError);
  EXPECT_EQ(testing::ReadFile(folder.path() / "a.txt"), "theirs");
}

TEST(AtomicFile, AFullDiskIsAnError) {
  if (!HasFullDevice()) GTEST_SKIP() << "no /dev/full on this system";
  EXPECT_THROW(WriteTextFile("/dev/full", "x"), OutputError);
}

}  // namespace
}  // namespace trajlo
