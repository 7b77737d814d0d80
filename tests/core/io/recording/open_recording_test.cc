// SPDX-License-Identifier: MIT
#include "core/io/recording/open_recording.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include "core/io/errors.h"
#include "core/io/recording/open_clouds.h"
#include "tests/support/room_recording.h"
#include "tests/support/temp_folder.h"

namespace trajlo {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using trajlo::testing::RoomRecording;
using trajlo::testing::TempFolder;

RoomRecording SmallRoom(int scans) {
  RoomRecording room;
  room.scans = scans;
  room.columns = 8;
  return room;
}

TEST(InputPaths, SeparatesByCommasOrTakesTheFoldersOfTheLidars) {
  const TempFolder temp;
  EXPECT_THAT(InputPaths("a,b,,c"), ElementsAre("a", "b", "c"));
  EXPECT_THAT(InputPaths(""), ElementsAre());
  EXPECT_THAT(InputPaths(temp.path()), ElementsAre(temp.path().string()));
  std::filesystem::create_directories(temp / "a,b");
  EXPECT_THAT(InputPaths(temp / "a,b"), ElementsAre((temp / "a,b").string()));
  for (const char* name : {"lidar0", "lidar1", "lidar3"}) {
    std::filesystem::create_directories(temp / name);
  }
  EXPECT_THAT(InputPaths(temp.path()),
              ElementsAre((temp / "lidar0").string(), (temp / "lidar1").string()));
}

TEST(OpenRecording, MergesLidarsByTheStampsOfTheirScans) {
  const TempFolder temp;
  SmallRoom(4).Write(temp / "a");
  SmallRoom(2).Write(temp / "b");
  trajlo::testing::WriteFile(temp / "b/timestamps.txt", "1000.15\n1000.25\n");
  const auto recording = OpenRecording({temp / "a", temp / "b"}, {});
  EXPECT_EQ(recording->size(), 6u);
  EXPECT_THAT(recording->description(), HasSubstr("lidar 1 is 2 scans"));
  LidarScan scan;
  std::vector<std::pair<int, std::int64_t>> order;
  while (recording->Next(&scan)) {
    order.emplace_back(scan.lidar_id, scan.stamp_ns / 1'000'000 - 1'000'000);
  }
  using Scan = std::pair<int, std::int64_t>;
  EXPECT_THAT(order, ElementsAre(Scan(0, 0), Scan(0, 100), Scan(1, 150), Scan(0, 200), Scan(1, 250),
                                 Scan(0, 300)));
  EXPECT_EQ(recording->report().scans_read, 6u);
}

TEST(OpenRecording, MergesLidarsByTheTimesOfRecordingWhereAllFoldersHaveThem) {
  const TempFolder temp;
  SmallRoom(3).Write(temp / "a");
  SmallRoom(2).Write(temp / "b");
  // The second stamp of `a` is broken: by the stamps its scans would all come first.
  trajlo::testing::WriteFile(temp / "a/timestamps.txt", "1000.0\n999.9\n1000.2\n");
  trajlo::testing::WriteFile(temp / "b/timestamps.txt", "1000.05\n1000.15\n");
  trajlo::testing::WriteFile(temp / "a/record_times.txt", "1000.1\n1000.2\n1000.3\n");
  const auto lidars = [&] {
    const auto recording = OpenRecording({temp / "a", temp / "b"}, {});
    std::vector<int> ids;
    for (LidarScan scan; recording->Next(&scan);) ids.push_back(scan.lidar_id);
    return ids;
  };
  EXPECT_THAT(lidars(), ElementsAre(0, 0, 1, 1, 0));
  trajlo::testing::WriteFile(temp / "b/record_times.txt", "1000.15\n1000.25\n");
  EXPECT_THAT(lidars(), ElementsAre(0, 1, 0, 1, 0));
}

TEST(OpenRecording, WithOneThreadAScanIsReadWhenItIsAskedFor) {
  const TempFolder temp;
  SmallRoom(4).Write(temp / "a");
  const auto recording = OpenRecording({temp / "a"}, {}, 1);
  LidarScan scan;
  ASSERT_TRUE(recording->Next(&scan));
  std::filesystem::remove_all(temp / "a");
  EXPECT_FALSE(recording->Next(&scan));
  EXPECT_EQ(recording->report().scans_skipped, 3u);
}

TEST(ChosenInputs, TopicsAreNamesOfFoldersWhereThereIsNoBag) {
  const TempFolder temp;
  SmallRoom(2).Write(temp / "in/lidar0");
  SmallRoom(2).Write(temp / "in/lidar1");
  const std::string a = temp / "in/lidar0", b = temp / "in/lidar1";
  RecordingOptions options;
  EXPECT_THAT(ChosenInputs({a, b}, options), ElementsAre(a, b));
  options.topics = {"lidar1"};
  EXPECT_THAT(ChosenInputs({a, b + "/"}, options), ElementsAre(b + "/"));
  EXPECT_THAT(LidarNames({a, b}, options), ElementsAre(b));
  EXPECT_EQ(OpenRecording({a, b}, options)->size(), 2u);
  options.topics = {b, a};
  EXPECT_THAT(ChosenInputs({a, b}, options), ElementsAre(b, a));
  options.topics = {"/os1_cloud_node1/points", "/os1_cloud_node2/points"};  // Of a converted bag.
  EXPECT_THAT(ChosenInputs({a, b}, options), ElementsAre(a, b));
  options.topics = {"/os1_cloud_node1/points"};
  EXPECT_THROW(OpenRecording({a, b}, options), InputError);
  options.topics = {"/os1_cloud_node1/points", "/os1_cloud_node2/points"};
  try {
    ChosenInputs({"alone"}, options);
    FAIL() << "two topics of one folder";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("alone: folders of scans have no topics"));
  }
  options.topics = {"lidar1", "lidar2"};
  EXPECT_THROW(ChosenInputs({a, b}, options), InputError);
}

TEST(OpenRecording, TellsThatFoldersHaveNoUseForTopics) {
  const TempFolder temp;
  SmallRoom(2).Write(temp / "in/lidar0");
  SmallRoom(2).Write(temp / "in/lidar1");
  const std::string a = temp / "in/lidar0", b = temp / "in/lidar1";
  const auto warnings = [&](const std::vector<std::string>& inputs,
                            const std::vector<std::string>& topics) {
    RecordingOptions options;
    options.topics = topics;
    return OpenRecording(inputs, options)->report().warnings;
  };
  EXPECT_THAT(warnings({a}, {"/points"}),
              ElementsAre(HasSubstr("lidar0: input.topics (/points) is not used, as folders of "
                                    "scans have no topics")));
  EXPECT_THAT(warnings({a, b}, {"/a", "/b"}), ElementsAre(HasSubstr("input.topics (/a, /b)")));
  EXPECT_THAT(warnings({a, b}, {"lidar1", "lidar0"}), IsEmpty());
  EXPECT_THAT(warnings({a}, {}), IsEmpty());
}

TEST(OpenRecording, StampsThatMayBeInMillisecondsAreTold) {
  const TempFolder temp;
  SmallRoom(3).Write(temp / "a");
  trajlo::testing::WriteFile(temp / "a/timestamps.txt", "0\n100\n200\n");
  RecordingOptions options;
  EXPECT_THROW(OpenRecording({temp / "a"}, options), InputError);
  options.use_point_times.values = {false};
  EXPECT_THAT(OpenRecording({temp / "a"}, options)->report().warnings,
              ElementsAre(HasSubstr("timestamps.txt: stamps are 100 s apart: they may be in ms"),
                          HasSubstr("points have times (field 'time'), which input.point_time=none "
                                    "ignores")));
}

TEST(OpenRecording, APeriodContradictsStamps) {
  const TempFolder temp;
  SmallRoom(3).Write(temp / "a");
  RecordingOptions options;
  options.scan_period_s = 0.2;
  EXPECT_THROW(OpenRecording({temp / "a"}, options), InputError);
  options.use_point_times.values = {false};
  std::filesystem::remove(temp / "a/timestamps.txt");
  EXPECT_EQ(OpenRecording({temp / "a"}, options)->size(), 3u);
}

TEST(LidarNames, AreTopicsOrFoldersInTheOrderOfTheIds) {
  const TempFolder temp;
  SmallRoom(1).Write(temp / "folder");
  trajlo::testing::WriteFile(temp / "a.bag", "");
  const std::string folder = temp / "folder", bag = temp / "a.bag";
  RecordingOptions options;
  EXPECT_THAT(LidarNames({folder, bag}, options), ElementsAre(folder, bag));
  options.topics = {"/x", "/y"};
  EXPECT_THAT(LidarNames({folder, bag}, options),
              ElementsAre(folder, "/x of " + bag, "/y of " + bag));
}

/// A packet of a VLP-16 without a single return.
std::string EmptyVelodynePacket(int index, char product = 0x22) {
  std::string packet;
  for (int block = 0; block < 12; ++block) {
    const int azimuth_cdeg = (480 * index + 40 * block) % 36000;
    packet += std::string("\xff\xee") + static_cast<char>(azimuth_cdeg & 0xff) +
              static_cast<char>(azimuth_cdeg >> 8) + std::string(96, '\0');
  }
  const int time_us = 1327 * index;
  for (int byte = 0; byte < 4; ++byte) packet += static_cast<char>(time_us >> 8 * byte);
  return packet + '\x37' + product;
}

/// This many points in KITTI's format.
std::string KittiScan(int points) {
  std::string bytes;
  for (int i = 0; i < 4 * points; ++i) {
    const float number = 0.1F * static_cast<float>(i % 97);
    bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
  }
  return bytes;
}

std::string ErrorOf(const std::filesystem::path& input) {
  try {
    OpenRecording({input.string()}, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(OpenRecording, ABinFileOfVelodynePayloadsIsToldFromAScanByItsBytes) {
  const TempFolder temp;
  std::string payloads;
  for (int i = 0; i < 160; ++i) payloads += EmptyVelodynePacket(i);
  trajlo::testing::WriteFile(temp / "payloads.bin", payloads);
  trajlo::testing::WriteFile(temp / "payloads.raw", payloads);  // The name does not matter.
  EXPECT_THAT(OpenClouds(temp / "payloads.bin")->topics()[0].type, "VLP-16 packets");
  EXPECT_THAT(OpenClouds(temp / "payloads.raw")->topics()[0].type, "VLP-16 packets");
  // One damaged block does not make it a scan.
  payloads[200] = '\0';
  trajlo::testing::WriteFile(temp / "damaged.bin", payloads);
  EXPECT_THAT(OpenClouds(temp / "damaged.bin")->topics()[0].type, "VLP-16 packets");
}

TEST(OpenRecording, PacketsThatDoNotNameTheirModelAreReadWhenAnOptionNamesIt) {
  const TempFolder temp;
  std::string payloads;
  for (int i = 0; i < 160; ++i) payloads += EmptyVelodynePacket(i, '\0');
  trajlo::testing::WriteFile(temp / "old.bin", payloads);
  EXPECT_THAT(ErrorOf(temp / "old.bin"), HasSubstr("name it with input.velodyne_model: VLP-16"));
  RecordingOptions options;
  options.velodyne_model = VelodyneModel::kPuckHiRes;
  EXPECT_THAT(OpenRecording({temp / "old.bin"}, options)->description(),
              HasSubstr("Puck Hi-Res packets"));
}

TEST(OpenRecording, ASingleScanIsRefusedAndItsFolderIsNamedAsTheMend) {
  const TempFolder temp;
  trajlo::testing::WriteFile(temp / "000000.bin", KittiScan(100));
  EXPECT_THAT(ErrorOf(temp / "000000.bin"),
              AllOf(HasSubstr("it may be a single scan"), HasSubstr("give the folder")));
  trajlo::testing::WriteFile(temp / "odd.bin", KittiScan(100) + "?");
  EXPECT_THAT(ErrorOf(temp / "odd.bin"),
              AllOf(HasSubstr("does not begin with a data packet"), Not(HasSubstr("single scan"))));
}

TEST(OpenRecording, AFolderOfPayloadsIsNotTakenForScans) {
  const TempFolder temp;
  std::string payloads;
  for (int i = 0; i < 8; ++i) payloads += EmptyVelodynePacket(i);
  trajlo::testing::WriteFile(temp / "payloads.bin", payloads);
  EXPECT_THAT(ErrorOf(temp.path()),
              AllOf(HasSubstr("packets of a Velodyne"), HasSubstr("Give the file itself")));
}

/// What a user who is not root is told about a file or folder without any rights.
std::string ErrorWithoutRights(const TempFolder& temp, const std::string& name) {
  namespace fs = std::filesystem;
  fs::permissions(temp.path(), fs::perms::owner_all | fs::perms::others_exec);
  fs::permissions(temp / name, fs::perms::none);
  const bool is_root = geteuid() == 0;
  constexpr uid_t kNobody = 65534;
  EXPECT_EQ(is_root ? seteuid(kNobody) : 0, 0);
  const std::string error = ErrorOf(temp / name);
  EXPECT_EQ(is_root ? seteuid(0) : 0, 0);
  fs::permissions(temp / name, fs::perms::owner_all);
  return error;
}

TEST(OpenRecording, WhatMayNotBeReadIsNamedAsSuch) {
  const TempFolder temp;
  for (const char* name : {"a.bag", "a.mcap", "a.db3", "a.pcap", "a.bin"}) {
    trajlo::testing::WriteFile(temp / name, "#ROSBAG V2.0");
    EXPECT_THAT(ErrorWithoutRights(temp, name), HasSubstr("Permission denied")) << name;
  }
  SmallRoom(2).Write(temp / "folder");
  EXPECT_THAT(ErrorWithoutRights(temp, "folder"), HasSubstr("Permission denied"));
  EXPECT_THAT(ErrorOf(temp / "absent"), HasSubstr("no such file or folder"));
}

TEST(OpenRecording, AFileOfMessagesIsToldByItsBytesAndNotByItsName) {
  const TempFolder temp;
  const std::filesystem::path fixtures =
      std::filesystem::path(TRAJLO_TEST_DIR).parent_path() / "ros2/fixtures";
  const std::string mcap = trajlo::testing::ReadFile(fixtures / "none.mcap");
  for (const char* name : {"a.bag", "a.db3", "a"}) {
    trajlo::testing::WriteFile(temp / name, mcap);
    EXPECT_EQ(OpenClouds(temp / name)->topics().size(), 19u) << name;
  }
}

TEST(OpenRecording, OneFolderThatIsMissingIsAnError) {
  const TempFolder temp;
  SmallRoom(2).Write(temp / "a");
  EXPECT_THROW(OpenRecording({temp / "a", temp / "missing"}, {}), InputError);
}

}  // namespace
}  // namespace trajlo
