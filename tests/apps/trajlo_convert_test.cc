// SPDX-License-Identifier: MIT
// The command as a user calls it.
#include <gmock/gmock.h>

#include "core/io/conversion/open_bag.h"
#include "core/io/conversion/scan_bag_writer.h"
#include "core/io/recording/open_clouds.h"
#include "core/io/recording/open_recording.h"
#include "core/io/trajectory_reader.h"
#include "tests/apps/command_testing.h"
#include "tests/support/room_recording.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

Outcome Convert(const std::vector<std::string>& arguments) {
  return CallProgram(TRAJLO_CONVERT, arguments);
}

std::vector<LidarScan> ReadAll(const std::string& path) {
  const auto recording = OpenRecording(InputPaths(path), {});
  std::vector<LidarScan> scans;
  LidarScan scan;
  while (recording->Next(&scan)) scans.push_back(scan);
  return scans;
}

class TrajloConvert : public ::testing::Test {
 protected:
  TrajloConvert() { RoomRecording().Write(folder_ / "room"); }
  std::string Path(const std::string& name) const { return (folder_ / name).string(); }

  TempFolder folder_;
};

TEST_F(TrajloConvert, HelpTeachesByExample) {
  const Outcome help = Convert({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, AllOf(HasSubstr("trajlo_convert recording.bag part.bag --start_s=60"),
                              Not(HasSubstr("minloglevel"))));
}

TEST_F(TrajloConvert, APathThatIsWrongIsSaidFirst) {
  const Outcome outcome = Convert({Path("nothere"), Path("map.ply")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("nothere"), HasSubstr("no such file")));
}

TEST_F(TrajloConvert, ATrajectoryBecomesOneOfAnotherFormat) {
  WriteFile(Path("truth.csv"), "#t,x,y,z,qw,qx,qy,qz\n5000000000,1,2,3,1,0,0,0\n");
  ASSERT_EQ(Convert({Path("truth.csv"), Path("truth.tum")}).exit_code, 0);
  const std::vector<StampedPose> poses = ReadTum(Path("truth.tum"));
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_EQ(poses[0].t_ns, 5'000'000'000);
  EXPECT_EQ(poses[0].T_world_body.t, Eigen::Vector3d(1, 2, 3));
  ASSERT_EQ(Convert({Path("truth.tum"), Path("truth.txt")}).exit_code, 0);
  EXPECT_EQ(ReadFile(Path("truth_times.txt")), "5.000000000\n");
  const Outcome without_times = Convert({Path("truth.txt"), Path("again.tum")});
  EXPECT_EQ(without_times.exit_code, 2);
  EXPECT_THAT(without_times.err, HasSubstr("without stamps"));
  WriteFile(Path("prism.tum"), "1 2 3 4\n2 3 4 5\n");
  const Outcome prism = Convert({Path("prism.tum"), Path("turned.tum")});
  EXPECT_EQ(prism.exit_code, 0);
  EXPECT_THAT(prism.err, HasSubstr("positions without rotations"));
  EXPECT_EQ(Convert({Path("truth.csv"), Path("truth.tum")}).exit_code, 5);
  EXPECT_EQ(Convert({Path("truth.csv"), Path("truth.bag")}).exit_code, 1);
}

TEST_F(TrajloConvert, MapsAndPosesOfARecordingAreSentToAResult) {
  const Outcome map = Convert({Path("room"), Path("a.ply")});
  EXPECT_EQ(map.exit_code, 1);
  EXPECT_THAT(map.err, AllOf(HasSubstr("comes from a result"), HasSubstr("trajlo_convert RESULT")));
  const Outcome poses = Convert({Path("room"), Path("a.tum")});
  EXPECT_EQ(poses.exit_code, 1);
  EXPECT_THAT(poses.err, HasSubstr("--poses=TOPIC"));
}

TEST_F(TrajloConvert, AnEmptyFileIsSaidToBeOne) {
  WriteFile(Path("empty.bag"), "");
  const Outcome outcome = Convert({Path("empty.bag"), Path("scans")});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("the file is empty"));
}

TEST_F(TrajloConvert, WrongUsageExitsWithOne) {
  EXPECT_EQ(Convert({Path("room")}).exit_code, 1);
  EXPECT_EQ(Convert({Path("room"), Path("a.bag"), "--layout=hexagon"}).exit_code, 1);
  EXPECT_EQ(Convert({Path("room"), Path("a.bag"), "--compression=zip"}).exit_code, 1);
  EXPECT_EQ(Convert({Path("room"), Path("a"), "--layout=ouster"}).exit_code, 1);
  EXPECT_EQ(Convert({Path("room"), Path("a.ply")}).exit_code, 1);
  EXPECT_EQ(Convert({Path("room"), Path("a.db3"), "--compression=lz4"}).exit_code, 1);
  EXPECT_EQ(Convert({Path("room"), Path("a.bag"), "--start_s=-1"}).exit_code, 1);
  EXPECT_EQ(Convert({Path("room"), Path("a.bag"), "--set=input.unit=s"}).exit_code, 1);
}

TEST_F(TrajloConvert, AMisspeltEndingMakesNoFolder) {
  for (const auto& [name, nearest] :
       {std::pair{"a.bgg", ".bag"}, {"a.mcpa", ".mcap"}, {"a.BAG", ".bag"}, {"a.pcap", ".mcap"}}) {
    const Outcome outcome = Convert({Path("room"), Path(name)});
    EXPECT_EQ(outcome.exit_code, 1) << name;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("must end in .mcap, .db3 or .bag, not in"),
                                   HasSubstr("did you mean " + std::string(nearest) + "?")));
    EXPECT_FALSE(std::filesystem::exists(Path(name)));
  }
  const Outcome poses = Convert({Path("room"), Path("poses.bag"), "--poses=/truth"});
  EXPECT_EQ(poses.exit_code, 1);
  EXPECT_THAT(poses.err, HasSubstr("must end in .tum or .txt, not in .bag"));
  for (const char* name : {"folder", "version1.2/"}) {
    EXPECT_EQ(Convert({Path("room"), Path(name)}).exit_code, 0) << name;
    EXPECT_TRUE(std::filesystem::exists(Path(name) + "/scans/000000.pcd"));
  }
}

TEST_F(TrajloConvert, AFlagAndTheOptionThatItIsShortForMustNotContradict) {
  const Outcome outcome =
      Convert({Path("room"), Path("part"), "--start_s=0.2", "--set=input.start_s=0.4"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("--start_s=0.2"));
  EXPECT_EQ(
      Convert({Path("room"), Path("part"), "--start_s=0.2", "--set=input.start_s=0.2"}).exit_code,
      0);
}

TEST_F(TrajloConvert, AFolderBecomesABagAndAFolderAgainWithTheSamePoints) {
  const Outcome to_bag = Convert({Path("room"), Path("a.bag"), "--compression=lz4"});
  ASSERT_EQ(to_bag.exit_code, 0) << to_bag.err;
  EXPECT_THAT(to_bag.out, HasSubstr("12 scans of 1 LiDAR"));
  ASSERT_EQ(Convert({Path("a.bag"), Path("again")}).exit_code, 0);
  const std::vector<LidarScan> before = ReadAll(Path("room")), after = ReadAll(Path("again"));
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    ASSERT_EQ(before[i].points.size(), after[i].points.size());
    EXPECT_EQ(before[i].stamp_ns, after[i].stamp_ns);
    for (std::size_t k = 0; k < before[i].points.size(); ++k) {
      ASSERT_EQ(before[i].points[k].xyz_m, after[i].points[k].xyz_m);
      ASSERT_EQ(before[i].points[k].t_ns, after[i].points[k].t_ns);
    }
  }
}

TEST_F(TrajloConvert, ThroughBagsOfAllKindsThePointsStayTheSame) {
  const std::vector<LidarScan> before = ReadAll(Path("room"));
  std::string last = "room";
  for (const char* next : {"a.mcap", "b.bag", "c.db3", "d.mcap", "e.db3", "f.bag", "folder"}) {
    const Outcome outcome = Convert({Path(last), Path(next)});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    last = next;
    const std::vector<LidarScan> after = ReadAll(Path(next));
    ASSERT_EQ(before.size(), after.size()) << next;
    for (std::size_t i = 0; i < before.size(); ++i) {
      ASSERT_EQ(before[i].stamp_ns, after[i].stamp_ns);
      ASSERT_EQ(before[i].points.size(), after[i].points.size());
      for (std::size_t k = 0; k < before[i].points.size(); ++k) {
        ASSERT_EQ(before[i].points[k].xyz_m, after[i].points[k].xyz_m);
        ASSERT_EQ(before[i].points[k].t_ns, after[i].points[k].t_ns);
      }
    }
  }
}

TEST_F(TrajloConvert, ExcerptsAndTopicsHoldBetweenKindsOfBags) {
  ASSERT_EQ(Convert({Path("room"), Path("a.bag")}).exit_code, 0);
  ASSERT_EQ(
      Convert({Path("a.bag"), Path("part.mcap"), "--start_s=0.35", "--duration_s=0.4"}).exit_code,
      0);
  EXPECT_EQ(ReadAll(Path("part.mcap")).size(), 4u);
  const Outcome none = Convert({Path("a.bag"), Path("none.mcap"), "--topics=/none"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("/os_cloud_node/points (sensor_msgs/PointCloud2)"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "none.mcap"));
}

TEST_F(TrajloConvert, SeveralLidarsGetFoldersOfTheirOwn) {
  RoomRecording().Write(folder_ / "rig" / "lidar0");
  RoomRecording().Write(folder_ / "rig" / "lidar1");
  ASSERT_EQ(Convert({Path("rig"), Path("rig.bag")}).exit_code, 0);
  // All LiDARs of a bag, without asking which.
  ASSERT_EQ(Convert({Path("rig.bag"), Path("out")}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / "lidar0" / "scans" / "000011.pcd"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / "lidar1" / "timestamps.txt"));
  ASSERT_EQ(Convert({Path("rig.bag"), Path("one"), "--topics=/os1_cloud_node2/points"}).exit_code,
            0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "one" / "scans" / "000011.pcd"));
}

TEST_F(TrajloConvert, LidarsOfOneNameGetNamesOfTheirOwn) {
  ASSERT_EQ(Convert({Path("room"), Path("a.bag")}).exit_code, 0);
  ASSERT_EQ(Convert({Path("room"), Path("b.bag")}).exit_code, 0);
  const Outcome outcome = Convert({Path("a.bag") + "," + Path("b.bag"), Path("both.mcap")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("lidar 1 becomes /os1_cloud_node2/points"));
  const auto both = OpenMessages(Path("both.mcap"));
  std::vector<std::string> topics;
  for (const Topic& topic : both->topics()) topics.push_back(topic.name);
  EXPECT_THAT(topics, UnorderedElementsAre("/os1_cloud_node1/points", "/os1_cloud_node2/points"));
  // A folder's name must not be that of a bag either.
  ASSERT_EQ(
      Convert({Path("both.mcap"), Path("one.bag"), "--topics=/os1_cloud_node1/points"}).exit_code,
      0);
  ASSERT_EQ(Convert({Path("one.bag") + "," + Path("room"), Path("c.bag")}).exit_code, 0);
  EXPECT_EQ(OpenMessages(Path("c.bag"))->topics().size(), 2u);
  ASSERT_EQ(Convert({Path("room") + "," + Path("one.bag"), Path("d.bag")}).exit_code, 0);
  EXPECT_EQ(OpenMessages(Path("d.bag"))->topics().size(), 2u);
}

TEST_F(TrajloConvert, AnExcerptHasTheScansOfItsTime) {
  ASSERT_EQ(Convert({Path("room"), Path("part"), "--start_s=0.35", "--duration_s=0.4"}).exit_code,
            0);
  const std::vector<LidarScan> scans = ReadAll(Path("part"));
  ASSERT_EQ(scans.size(), 4u);
  EXPECT_EQ(scans[0].stamp_ns, 1'000'400'000'000);
  const Outcome nothing = Convert({Path("room"), Path("none"), "--start_s=100"});
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "none"));
}

TEST_F(TrajloConvert, PosesOutsideTheExcerptAreNoResult) {
  {
    ScanBagWriter bag(folder_ / "truth.bag", {});
    for (int i = 0; i < 20; ++i) bag.WritePose("/truth", 1'000'000'000'000 + i * 100'000'000, {});
    bag.Close();
  }
  const std::vector<std::string> poses = {Path("truth.bag"), Path("truth.tum"), "--poses=/truth"};
  const auto with = [&](const std::string& flag) {
    std::vector<std::string> arguments = poses;
    arguments.push_back(flag);
    return Convert(arguments);
  };
  const Outcome nothing = with("--start_s=100");
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_THAT(nothing.err,
              AllOf(HasSubstr("none of the 20 poses of /truth"), HasSubstr("--start_s")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "truth.tum"));
  ASSERT_EQ(with("--start_s=1.5").exit_code, 0);
  EXPECT_EQ(ReadTum(Path("truth.tum")).size(), 5u);
}

TEST_F(TrajloConvert, ATopicThatIsLeftOutIsThree) {
  {
    const auto bag = OpenBag(folder_ / "a.mcap");
    const SE3 pose;
    bag->Write({"/truth", PoseStampedDescription()}, 1,
               WritePoseStamped({0, 1, "world"}, pose, bag->encoding()));
    bag->Write({"/thing", {"demo/Thing", "", "uint32 number\n"}}, 2,
               WireWriter(bag->encoding()).Put(std::uint32_t{7}).bytes());
    bag->Close();
  }
  const Outcome all = Convert({Path("a.mcap"), Path("all.bag")});
  EXPECT_EQ(all.exit_code, 3);
  EXPECT_THAT(all.err, HasSubstr("/thing is left out"));
  EXPECT_EQ(OpenMessages(Path("all.bag"))->topics().size(), 1u);
  EXPECT_EQ(Convert({Path("a.mcap"), Path("one.bag"), "--topics=/truth"}).exit_code, 0);
  EXPECT_EQ(Convert({Path("a.mcap"), Path("all.db3")}).exit_code, 0);
}

TEST_F(TrajloConvert, StampsBefore1970AreKeptOrRefused) {
  std::string stamps;
  for (int i = 0; i < 12; ++i) stamps += std::to_string(-1.5 + 0.1 * i) + "\n";
  WriteFile(folder_ / "room/timestamps.txt", stamps);
  ASSERT_EQ(Convert({Path("room"), Path("a.db3")}).exit_code, 0);
  const std::vector<LidarScan> scans = ReadAll(Path("a.db3"));
  ASSERT_EQ(scans.size(), 12u);
  EXPECT_EQ(scans[0].stamp_ns, -1'500'000'000);
  const Outcome ros1 = Convert({Path("room"), Path("a.bag")});
  EXPECT_EQ(ros1.exit_code, 5);
  EXPECT_THAT(ros1.err, HasSubstr("the stamp -1.500000000 s does not fit: ROS 1 holds 0 to"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.bag"));
}

TEST_F(TrajloConvert, AnEarlierResultIsKeptUnlessAskedOtherwise) {
  WriteFile(folder_ / "a.bag", "precious");
  EXPECT_EQ(Convert({Path("room"), Path("a.bag")}).exit_code, 5);
  EXPECT_EQ(ReadFile(folder_ / "a.bag"), "precious");
  EXPECT_EQ(Convert({Path("room"), Path("a.bag"), "--overwrite"}).exit_code, 0);
  ASSERT_EQ(Convert({Path("room"), Path("out")}).exit_code, 0);
  EXPECT_EQ(Convert({Path("room"), Path("out")}).exit_code, 5);
  EXPECT_EQ(Convert({Path("room"), Path("out"), "--overwrite", "--duration_s=0.5"}).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "scans" / "000011.pcd"));
  EXPECT_EQ(Convert({Path("room"), Path("room"), "--overwrite"}).exit_code, 1);
  EXPECT_EQ(ReadAll(Path("room")).size(), 12u);
}

TEST_F(TrajloConvert, WhatIsReadIsNeverReplaced) {
  RoomRecording().Write(folder_ / "other");
  RoomRecording().Write(folder_ / "rig" / "lidar0");
  RoomRecording().Write(folder_ / "rig" / "lidar1");
  std::filesystem::create_directory_symlink(folder_ / "room", folder_ / "link");
  std::filesystem::create_directory(folder_ / "bags");
  ASSERT_EQ(Convert({Path("room"), Path("bags/a.bag")}).exit_code, 0);
  std::filesystem::copy(folder_ / "bags/a.bag", folder_ / "bags/b.bag.part");
  const std::string bag = ReadFile(folder_ / "bags/a.bag");
  const std::vector<std::pair<std::string, std::string>> mistakes = {
      {Path("room/scans"), Path("room")},
      {Path("room") + "," + Path("other"), Path("room")},
      {Path("other") + "," + Path("room"), Path("room/.")},
      {Path("room"), Path("link")},
      {Path("link/scans"), Path("room")},
      {Path("rig"), Path("rig/lidar1")},
      {Path("rig/lidar0"), Path("rig")},
      {Path("bags/a.bag") + "," + Path("other"), Path("bags/a.bag")},
      {Path("bags"), Path("bags/a.bag")},
      {Path("bags/b.bag.part"), Path("bags/b.bag")},
  };
  for (const auto& [input, output] : mistakes) {
    const Outcome outcome = Convert({input, output, "--overwrite"});
    EXPECT_EQ(outcome.exit_code, 1) << input << " " << output;
    EXPECT_THAT(outcome.err, AnyOf(HasSubstr("choose another output"), HasSubstr("the same")));
  }
  for (const char* whole : {"room", "other", "rig/lidar0", "rig/lidar1"}) {
    EXPECT_EQ(ReadAll(Path(whole)).size(), 12u) << whole;
  }
  EXPECT_EQ(ReadFile(folder_ / "bags/a.bag"), bag);
  EXPECT_EQ(ReadFile(folder_ / "bags/b.bag.part"), bag);
}

TEST_F(TrajloConvert, WhatLiesBesideTheInputMayBeReplaced) {
  ASSERT_EQ(Convert({Path("room"), Path("room/part")}).exit_code, 0);
  EXPECT_EQ(Convert({Path("room/scans"), Path("room/part"), "--overwrite"}).exit_code, 0);
  ASSERT_EQ(Convert({Path("room/scans"), Path("room/a.bag")}).exit_code, 0);
  EXPECT_EQ(Convert({Path("room/scans"), Path("room/a.bag"), "--overwrite"}).exit_code, 0);
}

TEST_F(TrajloConvert, ADamagedRecordingIsConvertedAsFarAsItGoes) {
  WriteFile(RoomRecording::File(folder_ / "room", 3), "no scan");
  const Outcome outcome = Convert({Path("room"), Path("a.bag")});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("000003.pcd"));
  EXPECT_EQ(ReadAll(Path("a.bag")).size(), 11u);
}

}  // namespace
}  // namespace trajlo::testing
