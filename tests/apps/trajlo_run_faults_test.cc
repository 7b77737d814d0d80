// SPDX-License-Identifier: MIT
// What the command does when something is wrong with the recording: the exit codes that scripts
// rely on, a message that says what to do, and results that are kept.
#include <random>

#include "tests/apps/trajlo_run_testing.h"

namespace trajlo::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

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

TEST_F(TrajloRunTest, ScansOfAnotherFormatAreThreeAndNamed) {
  RoomRecording().Write(input());
  fs::remove(temp_ / "in/timestamps.txt");
  for (const int i : {10, 11}) {
    const fs::path file = RoomRecording::File(input(), i);
    fs::rename(file, fs::path(file).replace_extension(".ply"));
  }
  const Outcome outcome = Run();
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("2 scans are left out"));
  EXPECT_THAT(RunJson()["warnings"].dump(),
              AllOf(HasSubstr("the first 000010.ply"), HasSubstr("a scan every 100 ms")));
  EXPECT_EQ(RunJson()["input"]["scans"]["left_out"], 2);
}

TEST_F(TrajloRunTest, MissingNumbersAreWhatAPauseIsInABag) {
  RoomRecording room;
  room.scans = 40;
  room.speed_m_per_s = 0.0;
  room.Write(input());
  fs::remove(temp_ / "in/timestamps.txt");
  fs::remove(RoomRecording::File(input(), 20));
  const Outcome one = Run();
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_THAT(one.err, HasSubstr("1 scan is missing, between 000019.pcd and 000021.pcd"));
  for (int i = 15; i < 30; ++i) fs::remove(RoomRecording::File(input(), i));
  const Outcome many = Run({"--overwrite"});
  EXPECT_EQ(many.exit_code, 3);
  EXPECT_THAT(many.err, HasSubstr("nothing was measured"));
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

TEST_F(TrajloRunTest, LessDataThanTellsOfASecondHasNoMedian) {
  RoomRecording room;
  room.scans = 4;
  room.Write(input());
  EXPECT_THAT(Run().out, AllOf(HasSubstr("x real time"), Not(HasSubstr("median"))));
}

TEST_F(TrajloRunTest, ScansWithoutTimesWarnUnlessTheyAreDeclaredMotionCorrected) {
  RoomRecording room;
  fs::create_directories(temp_ / "in/velodyne");
  std::ofstream times(temp_ / "in/times.txt");
  for (int i = 0; i < room.scans; ++i) {
    std::vector<Eigen::Vector4f> points = room.Scan(i);
    for (Eigen::Vector4f& point : points) point[3] = 0.5F;  // Of a .bin: the intensity.
    times << RoomRecording::kPeriod * i << "\n";
    const std::string name = "in/velodyne/" + std::to_string(100 + i) + ".bin";
    std::ofstream(temp_ / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(points.data()),
               static_cast<std::streamsize>(points.size() * sizeof(points[0])));
  }
  times.close();
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

}  // namespace
}  // namespace trajlo::testing
