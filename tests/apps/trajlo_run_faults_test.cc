// SPDX-License-Identifier: MIT
// What the command does when something is wrong: the exit codes that scripts rely on, a message
// that says what to do, and results that are kept.
#include <sys/stat.h>

#include <csignal>
#include <random>

#include "tests/apps/trajlo_run_testing.h"
#include "tests/support/sanitizers.h"

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
  EXPECT_THAT(outcome.err, HasSubstr("input.start_s lies behind their end"));
}

TEST_F(TrajloRunTest, PointsOfAllFatesAreAllPoints) {
  RoomRecording room;
  room.scans = 40;
  room.Write(temp_ / "in");
  Run({"--set=sensor.max_range_m=1.6"});
  const auto points = RunJson()["input"]["points"];
  EXPECT_GT(points["too_far"].get<std::int64_t>(), 0);
  std::int64_t sum = 0;
  for (const char* fate :
       {"kept", "not_finite", "too_near", "too_far", "too_late", "wrong_time", "without_time"}) {
    sum += points[fate].get<std::int64_t>();
  }
  EXPECT_EQ(sum, points["received"].get<std::int64_t>()) << points;
}

TEST_F(TrajloRunTest, SeveralTopicsWithoutTheirPosesAreRefused) {
  WriteFile(temp_ / "in.bag", "");
  const Outcome outcome =
      Call({"--input=" + input() + ".bag", "--output=" + output(), "--set=input.topics=[/a, /b]"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("sensor.T_body_lidar"), HasSubstr("# /b of ")));
}

TEST_F(TrajloRunTest, OptionsThatARecordingHasNoUseForAreRefused) {
  RoomRecording room;
  room.scans = 4;
  room.Write(temp_ / "in");
  const Outcome model = Run({"--set=input.velodyne_model=VLP-16"});
  EXPECT_EQ(model.exit_code, 1);
  EXPECT_THAT(model.err, HasSubstr("input.velodyne_model is for captures of packets"));
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

TEST_F(TrajloRunTest, MissingAndEmptyFoldersAreTwo) {
  Outcome outcome = Run();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr(input()));
  fs::create_directories(input());
  outcome = Run();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr(input()));
  EXPECT_FALSE(fs::exists(output()));
}

TEST_F(TrajloRunTest, ARecordingWithoutAnyPointIsTwo) {
  RoomRecording room;
  room.scans = 3;
  room.Write(input());
  for (int i = 0; i < room.scans; ++i)
    RoomRecording::WriteScan(RoomRecording::File(input(), i), {});
  const Outcome outcome = Run();
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
}

TEST_F(TrajloRunTest, ATruncatedFileIsThreeAndTheResultIsThere) {
  RoomRecording().Write(input());
  const fs::path file = RoomRecording::File(input(), 7);
  fs::resize_file(file, fs::file_size(file) / 2);
  const Outcome outcome = Run();
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("000007.pcd"));
  EXPECT_GT(Trajectory().size(), 25u);
  EXPECT_EQ(RunJson()["exit"]["reason"], "partial_input");
  EXPECT_EQ(RunJson()["input"]["scans"]["damaged"], 1);
}

TEST_F(TrajloRunTest, AnUnreadableFileIsThreeAndTheOthersAreUsed) {
  RoomRecording().Write(input());
  WriteFile(RoomRecording::File(input(), 9), "this is no point cloud");
  const Outcome outcome = Run();
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(RunJson()["input"]["scans"]["skipped"], 1);
  EXPECT_EQ(RunJson()["input"]["scans"]["read"], 11);
}

TEST_F(TrajloRunTest, AScanOfNansIsCountedAndBridged) {
  const RoomRecording room;
  room.Write(input());
  std::vector<Eigen::Vector4f> points = room.Scan(6);
  for (Eigen::Vector4f& p : points) p.head<3>().setConstant(std::nanf(""));
  RoomRecording::WriteScan(RoomRecording::File(input(), 6), points);
  const Outcome outcome = Run();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(RunJson()["input"]["points"]["not_finite"], points.size());
  EXPECT_LT(Trajectory().back().T_world_body.t.norm(), 1.0);
}

TEST_F(TrajloRunTest, AWorldThatDisappearsIsFourAndSaysWhen) {
  RoomRecording room;
  room.scans = 30;
  room.Write(input());
  std::mt19937 engine(1);
  std::uniform_real_distribution<float> somewhere(-80.0F, 80.0F);
  for (int i = 8; i < room.scans; ++i) {
    std::vector<Eigen::Vector4f> points = room.Scan(i);
    for (Eigen::Vector4f& p : points) {
      for (int axis = 0; axis < 3; ++axis) p[axis] = somewhere(engine);
    }
    RoomRecording::WriteScan(RoomRecording::File(input(), i), points);
  }
  const Outcome outcome = Run();
  EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("lost"));
  EXPECT_GT(Trajectory().size(), 30u) << "what was computed is kept";
  EXPECT_EQ(RunJson()["exit"]["code"], 4);
}

TEST_F(TrajloRunTest, AnEarlierResultIsFiveUnlessOverwritten) {
  RoomRecording().Write(input());
  ASSERT_EQ(Run().exit_code, 0);
  const std::string before = ReadFile(Result("run.json"));
  const Outcome outcome = Run();
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("earlier result"), HasSubstr("--overwrite")));
  EXPECT_EQ(ReadFile(Result("run.json")), before);
  EXPECT_EQ(Run({"--overwrite"}).exit_code, 0);
}

TEST_F(TrajloRunTest, AnOutputThatIsNoFolderIsFive) {
  RoomRecording().Write(input());
  for (const char* path : {"/dev/full", "/dev/null/below"}) {
    const Outcome outcome = Call({"--input=" + input(), std::string("--output=") + path});
    EXPECT_EQ(outcome.exit_code, 5) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(path));
  }
}

TEST_F(TrajloRunTest, AFullDiskIsFiveWhicheverFileMeetsIt) {
  RoomRecording().Write(input());
  for (const char* name : {"trajectory.tum", "windows.csv", "map.ply", "config.yaml", "run.json"}) {
    fs::remove_all(output());
    fs::create_directories(output());
    fs::create_symlink("/dev/full", Result(name));
    const Outcome outcome = Run({"--overwrite"});
    EXPECT_EQ(outcome.exit_code, 5) << name;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(name), HasSubstr("No space left"))) << name;
    EXPECT_THAT(outcome.out, Not(HasSubstr("0 of 0 scans"))) << name;
    if (std::string(name) == "map.ply") {
      EXPECT_THAT(outcome.out, HasSubstr("12 of 12 scans"));
    }
  }
}

TEST_F(TrajloRunTest, AKilledRunIsSaidToBeUnfinished) {
  RoomRecording().Write(input());
  fs::create_directories(output());
  WriteFile(Result("run.json"), R"({"exit": {"code": null, "reason": "running"}})");
  const Outcome outcome = Run();
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.err, HasSubstr("holds a result that did not finish (run.json)"));
  WriteFile(Result("run.json"), R"({"exit": {"code": 0, "reason": "ok"}})");
  EXPECT_THAT(Run().err, HasSubstr("holds an earlier result (run.json)"));
}

TEST_F(TrajloRunTest, AClosedPipeEndsAListSilently) {
  const std::string err = (temp_ / "err").string();
  const std::string command = std::string("bash -c 'set -o pipefail; ") + TRAJLO_RUN +
                              " --show_config 2>" + err + " | head -1 >/dev/null'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(ReadFile(err), "");
}

TEST_F(TrajloRunTest, LessDataThanTellsOfASecondHasNoMedian) {
  RoomRecording room;
  room.scans = 4;
  room.Write(input());
  EXPECT_THAT(Run().out, AllOf(HasSubstr("x real time"), Not(HasSubstr("median"))));
}

TEST_F(TrajloRunTest, APipeThatNobodyReadsIsFiveAndDoesNotHang) {
  RoomRecording().Write(input());
  fs::create_directories(output());
  ASSERT_EQ(mkfifo(Result("trajectory.tum").c_str(), 0600), 0);
  const Outcome outcome = Run({"--overwrite"});
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.err, HasSubstr("is a pipe that nobody reads"));
}

TEST_F(TrajloRunTest, TooLittleMemoryIsSixWithASentence) {
  if (testing::kSanitized) GTEST_SKIP() << "sanitizers reserve more memory than there is";
  RoomRecording().Write(input());
  int failed = 0;
  for (const char* kilobytes : {"32000", "40000", "50000", "64000", "80000", "120000"}) {
    const Outcome outcome = CallProgram(
        "/bin/bash", {"-c", std::string("ulimit -v ") + kilobytes + R"(; exec "$0" "$@")",
                      TRAJLO_RUN, input(), "-o", output(), "--overwrite"});
    // 3: too little for some scans only. 127: too little to load the program.
    EXPECT_THAT(outcome.exit_code, ::testing::AnyOf(0, 3, 6, 127)) << kilobytes << outcome.err;
    if (outcome.exit_code != 6) continue;
    ++failed;
    EXPECT_THAT(outcome.err,
                ::testing::AnyOf(HasSubstr("there is not enough memory"),
                                 HasSubstr("no thread could be started"), HasSubstr("failed: ")));
  }
  EXPECT_GT(failed, 0);
}

TEST_F(TrajloRunTest, ScansWithoutTimesWarnUnlessTheyAreDeclaredMotionCorrected) {
  RoomRecording room;
  fs::create_directories(temp_ / "in/velodyne");
  for (int i = 0; i < room.scans; ++i) {
    std::vector<Eigen::Vector4f> points = room.Scan(i);
    for (Eigen::Vector4f& point : points) point[3] = 0.5F;  // Of a .bin: the intensity.
    const std::string name = "in/velodyne/" + std::to_string(100 + i) + ".bin";
    std::ofstream(temp_ / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(points.data()),
               static_cast<std::streamsize>(points.size() * sizeof(points[0])));
  }
  const Outcome silent = Run();
  EXPECT_EQ(silent.exit_code, 0) << silent.err;
  EXPECT_THAT(silent.err, AllOf(HasSubstr("points have no times of their own"),
                                HasSubstr("input.point_time=none")));
  EXPECT_THAT(RunJson()["warnings"].dump(), HasSubstr("points have no times"));
  const Outcome declared = Run({"--overwrite", "--set=input.point_time=none"});
  EXPECT_EQ(declared.exit_code, 0);
  EXPECT_EQ(declared.err, "");
  EXPECT_THAT(declared.out, ::testing::Not(HasSubstr("turned up")));
  const Outcome kitti = Run({"--overwrite", "--config", "kitti"});
  EXPECT_EQ(kitti.err, "");
  EXPECT_THAT(kitti.out, HasSubstr("every ray is turned up by 0.205 degrees"));
}

TEST_F(TrajloRunTest, ADiskThatFillsUpLaterIsFiveAndKeepsWhatWasWritten) {
  RoomRecording room;
  room.scans = 30;
  room.Write(input());
  // config.yaml needs about 10 kB; windows.csv outgrows the bound after some windows.
  const Outcome outcome = Call({"--input=" + input(), "--output=" + output()}, 16'000);
  EXPECT_EQ(outcome.exit_code, 5) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("too large"));
  EXPECT_EQ(RunJson()["exit"]["code"], 5);
  EXPECT_GT(Trajectory().size(), 3u);
}

/// A run that is under way: some poses are written, and many scans are left.
class InterruptedRunTest : public TrajloRunTest {
 protected:
  void SetUp() override {
    RoomRecording room;
    room.scans = 1;
    room.Write(input());
    std::ofstream stamps(temp_ / "in/timestamps.txt");
    for (int i = 0; i < kScans; ++i) {
      stamps << std::to_string(RoomRecording::kStart + 0.1 * i) << "\n";
      if (i > 0)
        fs::create_hard_link(RoomRecording::File(input(), 0), RoomRecording::File(input(), i));
    }
    stamps.close();
    process_ = std::make_unique<Process>(
        std::vector<std::string>{TRAJLO_RUN, "--input=" + input(), "--output=" + output()});
    while (PosesWritten() < 10 && !process_->HasEnded()) usleep(1000);
  }

  std::ptrdiff_t PosesWritten() const {
    const std::string text = ReadFile(Result("trajectory.tum"));
    return std::count(text.begin(), text.end(), '\n');
  }

  static constexpr int kScans = 1000;
  std::unique_ptr<Process> process_;
};

TEST_F(InterruptedRunTest, SignalsEndTheRunWithAllFilesAnd130) {
  process_->Signal(SIGINT);
  EXPECT_EQ(process_->Wait(), 130) << process_->Err();
  EXPECT_EQ(RunJson()["exit"]["reason"], "interrupted");
  EXPECT_EQ(RunJson()["result"]["poses_written"], Trajectory().size());
  EXPECT_LT(RunJson()["input"]["scans"]["read"], kScans);
  EXPECT_TRUE(fs::exists(Result("map.ply")));
}

TEST_F(InterruptedRunTest, TerminationIsTheSame) {
  process_->Signal(SIGTERM);
  EXPECT_EQ(process_->Wait(), 130);
  EXPECT_GE(Trajectory().size(), 10u);
}

TEST_F(InterruptedRunTest, AKilledRunLeavesAReadablePrefixThatSaysSo) {
  process_->Signal(SIGKILL);
  EXPECT_EQ(process_->Wait(), -SIGKILL);
  EXPECT_GE(Trajectory().size(), 10u);
  const std::string text = ReadFile(Result("trajectory.tum"));
  EXPECT_EQ(text.back(), '\n');
  EXPECT_EQ(RunJson()["exit"]["reason"], "running");
  EXPECT_TRUE(RunJson()["exit"]["code"].is_null());
  EXPECT_EQ(Run().exit_code, 5);  // Nor is it replaced without being told so.
}

}  // namespace
}  // namespace trajlo::testing
