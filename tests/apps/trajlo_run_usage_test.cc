// SPDX-License-Identifier: MIT
// What the command does when it is called wrongly: exit code 1, and a message that says what to do.
#include "tests/apps/trajlo_run_testing.h"

namespace trajlo::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST_F(TrajloRunTest, WrongUsageIsOne) {
  const auto error = [](const std::vector<std::string>& arguments) {
    const Outcome outcome = Call(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
    return outcome.err;
  };
  EXPECT_THAT(error({}), AllOf(HasSubstr("no recording given"), HasSubstr("--help")));
  EXPECT_THAT(error({"--input=x"}), HasSubstr("--output is missing"));
  EXPECT_THAT(error({"--input=x", "--output=y", "z"}), HasSubstr("unexpected argument 'z'"));
  EXPECT_THAT(error({"--imput=x"}), HasSubstr("imput"));
  EXPECT_THAT(error({"--input=x", "--output=y", "--set=window.segmets=3"}),
              HasSubstr("did you mean 'window.segments'"));
  EXPECT_THAT(error({"--input=x", "--output=y", "--solver=newton"}), HasSubstr("--solver: "));
  EXPECT_THAT(error({"--input=x", "--output=y", "--threads=-2"}), HasSubstr("--threads: "));
  EXPECT_THAT(error({"--input=x", "--output=y", "--at=begin"}), HasSubstr("scan-end or scan-mid"));
  EXPECT_THAT(error({"--input=x", "--output=y", "--at=scan-end", "--rate=3"}),
              HasSubstr("exclude each other"));
  for (const char* windows : {"x", "-3", "9-7", "1.5", "3-", "0-999999999"}) {
    EXPECT_THAT(error({"--input=x", "--output=y", std::string("--inspect=") + windows}),
                HasSubstr("--inspect: must be numbers of windows"));
  }
  EXPECT_THAT(error({"--input=x", "--output=y", "--set=map.radius_m=1,map.voxel_size_m=2"}),
              HasSubstr("map.radius_m (1.0)"));
}

TEST_F(TrajloRunTest, SeveralLidarsWithoutTheirPosesAreRefused) {
  RoomRecording room;
  room.scans = 4;
  room.Write(temp_ / "in/lidar0");
  room.Write(temp_ / "in/lidar1");
  const Outcome without = Run();
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_THAT(without.err,
              AllOf(HasSubstr("2 LiDARs are read, and sensor.T_body_lidar is empty"),
                    HasSubstr("# " + input() + "/lidar1"), HasSubstr("T_body_lidar=[{}, {}]")));
  const Outcome too_few = Run({"--set=sensor.T_body_lidar=[{}]"});
  EXPECT_EQ(too_few.exit_code, 1);
  EXPECT_THAT(too_few.err, HasSubstr("sensor.T_body_lidar has 1"));
  EXPECT_FALSE(fs::exists(output()));
  EXPECT_EQ(Run({"--set=sensor.T_body_lidar=[{}, {}]"}).exit_code, 0);
}

TEST_F(TrajloRunTest, SeveralTopicsWithoutTheirPosesAreRefused) {
  WriteFile(temp_ / "in.bag", "");
  const Outcome outcome =
      Call({"--input=" + input() + ".bag", "--output=" + output(), "--set=input.topics=[/a, /b]"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("sensor.T_body_lidar"), HasSubstr("# /b of ")));
}

TEST_F(TrajloRunTest, ATopicThatIsGivenTwiceIsRefused) {
  WriteFile(temp_ / "in.bag", "");
  const Outcome outcome = Call({"--input=" + input() + ".bag", "--output=" + output(),
                                "--set=input.topics=[/a, /a],sensor.T_body_lidar=[{}, {}]"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("input.topics has '/a' twice"));
}

TEST_F(TrajloRunTest, MorePosesThanLidarsAreRefused) {
  RoomRecording room;
  room.scans = 4;
  room.Write(temp_ / "in");
  const Outcome one = Run({"--set=sensor.T_body_lidar=[{}, {}]"});
  EXPECT_EQ(one.exit_code, 1);
  EXPECT_THAT(one.err, AllOf(HasSubstr("one LiDAR is read"), HasSubstr("the poses of 2"),
                             HasSubstr(input())));
  WriteFile(temp_ / "in.bag", "");
  const Outcome two = Call({"--input=" + input() + ".bag", "--output=" + output(),
                            "--set=input.topics=[/a, /b],sensor.T_body_lidar=[{}, {}, {}]"});
  EXPECT_EQ(two.exit_code, 1);
  EXPECT_THAT(two.err, AllOf(HasSubstr("2 LiDARs are read"), HasSubstr("the poses of 3"),
                             HasSubstr("/b of ")));
  EXPECT_FALSE(fs::exists(output()));
  EXPECT_EQ(Run({"--set=sensor.T_body_lidar=[{}]"}).exit_code, 0);
}

TEST_F(TrajloRunTest, OptionsOfEachLidarAreOneOrAsManyAsThereAreLidars) {
  RoomRecording room;
  room.scans = 4;
  room.Write(temp_ / "in/lidar0");
  room.Write(temp_ / "in/lidar1");
  const std::string poses = "--set=sensor.T_body_lidar=[{}, {}],";
  const Outcome three = Run({poses + "input.clock_offset_s=[0,0,1]"});
  EXPECT_EQ(three.exit_code, 1);
  EXPECT_THAT(three.err, HasSubstr("input.clock_offset_s has 3 values, and 2 LiDARs are read"));
  const Outcome stamps = Run({poses + "input.stamps_file=stamps.txt"});
  EXPECT_EQ(stamps.exit_code, 1);
  EXPECT_THAT(stamps.err, HasSubstr("input.stamps_file: 2 LiDARs are read"));
  EXPECT_FALSE(fs::exists(output()));
  EXPECT_EQ(Run({poses + "input.clock_offset_s=[0,0],input.stamp_at=start"}).exit_code, 0);
}

TEST_F(TrajloRunTest, OptionsThatARecordingHasNoUseForAreRefused) {
  RoomRecording room;
  room.scans = 4;
  room.Write(temp_ / "in");
  const Outcome model = Run({"--set=input.velodyne_model=VLP-16"});
  EXPECT_EQ(model.exit_code, 1);
  EXPECT_THAT(model.err, HasSubstr("input.velodyne_model is for captures of packets"));
  // It may be of a configuration for the bag that the folder comes from.
  const Outcome topics = Run({"--set=input.topics=/points"});
  EXPECT_EQ(topics.exit_code, 0);
  EXPECT_THAT(topics.err, HasSubstr("input.topics (/points) is not used"));
  fs::remove_all(output());
  WriteFile(temp_ / "in.bag", "#ROSBAG V2.0");
  const Outcome period = Call(
      {"--input=" + input() + ".bag", "--output=" + output(), "--set=input.scan_period_s=0.2"});
  EXPECT_EQ(period.exit_code, 1);
  EXPECT_THAT(period.err, HasSubstr("input.scan_period_s is for folders"));
  const Outcome stamped = Run({"--set=input.scan_period_s=0.2"});
  EXPECT_EQ(stamped.exit_code, 2);
  EXPECT_THAT(stamped.err, HasSubstr("the scans have stamps"));
  EXPECT_FALSE(fs::exists(output()));
}

TEST_F(TrajloRunTest, PartsOfOneRecordingAreSentToTheirFolder) {
  WriteFile(temp_ / "walk_0.bag", "");
  WriteFile(temp_ / "walk_1.bag", "");
  const Outcome outcome = Call(
      {(temp_ / "walk_0.bag").string(), (temp_ / "walk_1.bag").string(), "--output=" + output()});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("parts of one recording, give the folder"),
                                 HasSubstr("sensor.T_body_lidar")));
}

TEST_F(TrajloRunTest, UnknownConfigKeyIsOneAndNamesTheLine) {
  WriteFile(temp_ / "my.yaml", "window:\n  segmets: 3\n");
  const Outcome outcome = Run({"--config=" + (temp_ / "my.yaml").string()});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("my.yaml:2:3: unknown key 'window.segmets'"),
                                 HasSubstr("'window.segments'")));
  EXPECT_FALSE(fs::exists(output()));
}

TEST_F(TrajloRunTest, AResultIsNoRecording) {
  RoomRecording room;
  room.scans = 6;
  room.Write(temp_ / "in");
  ASSERT_EQ(Run().exit_code, 0);
  const Outcome again = Call({"--input=" + output(), "--output=" + output() + "2"});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("a result of trajlo_run, not a recording"));
}

TEST_F(TrajloRunTest, AStartBehindTheEndIsNamed) {
  RoomRecording room;
  room.scans = 6;
  room.Write(temp_ / "in");
  const Outcome outcome = Run({"--set=input.start_s=100"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("input.start_s lies after their end"));
}

}  // namespace
}  // namespace trajlo::testing
