// SPDX-License-Identifier: MIT
// The command as a user calls it.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/io/conversion/scan_bag_writer.h"
#include "tests/apps/command_testing.h"
#include "tests/support/room_recording.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Outcome Info(const std::vector<std::string>& arguments) {
  return CallProgram(TRAJLO_INFO, arguments);
}

/// Two LiDARs whose stamps mark the end of the sweep, the second 37 ms behind the first.
void WriteRigBag(const std::filesystem::path& path) {
  ScanBagWriter bag(path, {});
  for (int i = 0; i < 10; ++i) {
    for (const std::int64_t phase_ns : {std::int64_t{0}, std::int64_t{37'000'000}}) {
      LidarScan scan;
      const std::int64_t start_ns = 1'700'000'000'000'000'000 + i * 100'000'000 + phase_ns;
      for (int k = 0; k < 1000; ++k) {
        scan.points.push_back({{5, 1, 0}, 0, start_ns + k * 100'000});
      }
      const std::int64_t end_ns = start_ns + 100'000'000;
      const std::string topic =
          phase_ns == 0 ? "/os1_cloud_node1/points" : "/os1_cloud_node2/points";
      bag.WriteScan(CloudLayout::kOuster, topic, "os_sensor",
                    {end_ns, start_ns, end_ns + 2'000'000}, scan);
    }
  }
  bag.WritePose("/leica/pose/relative", 1'700'000'001'000'000'000, {});
  bag.Close();
}

TEST(TrajloInfo, HelpTeachesByExampleAndWrongUsageExitsWithOne) {
  const Outcome help = Info({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out,
              AllOf(HasSubstr("trajlo_info recording.bag --quick"), Not(HasSubstr("minloglevel"))));
  EXPECT_EQ(Info({}).exit_code, 1);
  EXPECT_EQ(Info({"--nonsense"}).exit_code, 1);
}

TEST(TrajloInfo, TellsTopicsTimesAndTheCommandToUse) {
  const TempFolder folder;
  WriteRigBag(folder / "rig.bag");
  const Outcome outcome = Info({(folder / "rig.bag").string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("/leica/pose/relative"), HasSubstr("geometry_msgs/PoseStamped"),
                    HasSubstr("t uint32 @20"), HasSubstr("stamps mark its end"),
                    HasSubstr("messages were recorded 0.002 s after their stamp"),
                    HasSubstr("begin 37 ms after those of lidar 0"),
                    HasSubstr("rig.bag -o result -c ntu_viral "
                              "--set 'input.topics=[\"/os1_cloud_node1/points\", "
                              "\"/os1_cloud_node2/points\"]'")));
}

TEST(TrajloInfo, JsonHasTheSameForPrograms) {
  const TempFolder folder;
  WriteRigBag(folder / "rig.bag");
  const Outcome outcome = Info({(folder / "rig.bag").string(), "--json"});
  ASSERT_EQ(outcome.exit_code, 0);
  const nlohmann::json json = nlohmann::json::parse(outcome.out);
  const nlohmann::json& recording = json["recordings"][0];
  EXPECT_EQ(recording["topics"].size(), 3u);
  const nlohmann::json& lidar = recording["lidars"][1];
  EXPECT_EQ(lidar["times"]["unit"], "ns");
  EXPECT_EQ(lidar["times"]["origin"], "start");
  EXPECT_EQ(lidar["times"]["stamp_at"], "end");
  EXPECT_EQ(lidar["stamps"]["count"], 10);
  EXPECT_EQ(lidar["stamps"]["first_ns"], 1'700'000'000'137'000'000);
  EXPECT_NEAR(lidar["phase"]["after_first_lidar_s"].get<double>(), 0.037, 1e-9);
  EXPECT_EQ(lidar["points"]["total"], 10'000);
}

TEST(TrajloInfo, ADamagedRecordingIsShownAndExitsWithThree) {
  const TempFolder folder;
  WriteRigBag(folder / "whole.bag");
  const std::string bytes = ReadFile(folder / "whole.bag");
  WriteFile(folder / "cut.bag", bytes.substr(0, bytes.size() * 9 / 10));
  const Outcome outcome = Info({(folder / "cut.bag").string()});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("damaged"), HasSubstr("stamps mark its end")));
}

TEST(TrajloInfo, WhatIsUnreadableExitsWithTwoAfterShowingTheRest) {
  const TempFolder folder;
  RoomRecording().Write(folder / "room");
  const Outcome outcome = Info({(folder / "nothing").string(), (folder / "room").string()});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("nothing"));
  EXPECT_THAT(outcome.out, HasSubstr("lidar 0"));
}

TEST(TrajloInfo, CloudsWithoutAPointAreNothingToRunOn) {
  const TempFolder folder;
  RoomRecording room;
  room.Write(folder / "room");
  for (int i = 0; i < room.scans; ++i) {
    RoomRecording::WriteScan(RoomRecording::File(folder / "room", i), {});
  }
  const Outcome outcome = Info({(folder / "room").string()});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("no cloud has a point: there is nothing to run on"),
                                 HasSubstr("no point is a return"),
                                 ::testing::Not(HasSubstr("only 0 returns"))));
}

/// Of a Velodyne with old firmware that turns: every measurement is 10 m.
std::string UnnamedVelodynePacket(int index) {
  std::string packet;
  for (int block = 0; block < 12; ++block) {
    const int azimuth_cdeg = (480 * index + 40 * block) % 36000;
    packet += std::string("\xff\xee") + static_cast<char>(azimuth_cdeg & 0xff) +
              static_cast<char>(azimuth_cdeg >> 8);
    for (int laser = 0; laser < 32; ++laser) packet += "\x88\x13\x10";
  }
  const int time_us = 1327 * index;
  for (int byte = 0; byte < 4; ++byte) packet += static_cast<char>(time_us >> 8 * byte);
  return packet + std::string(2, '\0');
}

TEST(TrajloInfo, TheModelOfAVelodyneThatIsGivenStandsInTheCommandToUse) {
  const TempFolder folder;
  std::string payloads;
  for (int i = 0; i < 400; ++i) payloads += UnnamedVelodynePacket(i);
  WriteFile(folder / "old.bin", payloads);
  const std::string path = (folder / "old.bin").string();
  EXPECT_EQ(Info({path}).exit_code, 2);
  const Outcome wrong = Info({path, "--velodyne_model=VLP-17"});
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_THAT(wrong.err, HasSubstr("VLP-16 | Puck-Hi-Res | HDL-32E | VLP-32C"));
  const Outcome outcome = Info({path, "--velodyne_model=VLP-16"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("VLP-16 packets"), HasSubstr("input.velodyne_model=VLP-16")));
}

}  // namespace
}  // namespace trajlo::testing
