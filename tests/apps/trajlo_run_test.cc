// SPDX-License-Identifier: MIT
// The command as a user calls it, on recordings that are as they should be.
#include "tests/apps/trajlo_run_testing.h"

namespace trajlo::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST_F(TrajloRunTest, HelpTeachesByExample) {
  const Outcome outcome = Call({"--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("trajlo_run flight.bag -o result"),
                                 HasSubstr("--set window.segments=3")));
  // The flags of glog and gflags are nobody's business.
  EXPECT_THAT(outcome.out, ::testing::Not(HasSubstr("minloglevel")));
}

TEST_F(TrajloRunTest, VersionNamesWhatItStandsOn) {
  const Outcome outcome = Call({"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("trajlo_run "), HasSubstr("Ceres 2")));
}

TEST_F(TrajloRunTest, ShowConfigPrintsTheEffectiveConfiguration) {
  const Outcome outcome = Call({"--show_config", "--set=window.segments=7"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("\n  segments: 7\n"));
}

TEST_F(TrajloRunTest, WritesTheMotionOfTheRecording) {
  const RoomRecording room;
  room.Write(input());
  const Outcome outcome = Run();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("12 of 12 scans"), HasSubstr("point times: "),
                                 HasSubstr("x real time"), HasSubstr("ok (exit code 0)")));
  EXPECT_EQ(outcome.err, "");  // No progress bar: this is no terminal.

  const std::vector<StampedPose> poses = Trajectory();
  ASSERT_GT(poses.size(), 25u);
  for (const StampedPose& pose : poses) {
    const double t = 1e-9 * static_cast<double>(pose.t_ns) - RoomRecording::kStart;
    const Eigen::Vector3d truth(room.PositionX(t), 0.0, 0.0);
    EXPECT_LT((pose.T_world_body.t - truth).norm(), 0.03) << "at " << t << " s";
  }

  const nlohmann::json json = RunJson();
  EXPECT_EQ(json["exit"]["reason"], "ok");
  EXPECT_EQ(json["input"]["scans"]["read"], 12);
  EXPECT_EQ(json["input"]["points"]["received"], 12 * 360 * 16);
  EXPECT_EQ(json["result"]["poses_written"], poses.size());
  EXPECT_GT(json["resources"]["real_time_factor"], 0.0);
  EXPECT_GT(json["resources"]["estimation_ms_per_data_second"]["median"], 0.0);
  EXPECT_THAT(ReadFile(Result("map.ply")), HasSubstr("element vertex"));
  EXPECT_THAT(ReadFile(Result("view.ply")), HasSubstr("element vertex 30000\n"));
  const std::string windows = ReadFile(Result("windows.csv"));
  EXPECT_EQ(std::count(windows.begin(), windows.end(), '\n'),
            1 + json["windows"]["count"].get<int>());
}

TEST_F(TrajloRunTest, TheResultDoesNotDependOnThreads) {
  RoomRecording().Write(input());
  ASSERT_EQ(Run({"--threads=1"}).exit_code, 0);
  const std::string one = ReadFile(Result("trajectory.tum"));
  const std::string map_of_one = ReadFile(Result("map.ply"));
  const std::string view_of_one = ReadFile(Result("view.ply"));
  ASSERT_EQ(Run({"--threads=2", "--overwrite"}).exit_code, 0);
  EXPECT_EQ(ReadFile(Result("trajectory.tum")), one);
  EXPECT_EQ(ReadFile(Result("map.ply")), map_of_one);
  EXPECT_EQ(ReadFile(Result("view.ply")), view_of_one);
}

TEST_F(TrajloRunTest, WithoutAViewTheResultIsTheSameAndAnEarlierOneGoes) {
  RoomRecording().Write(input());
  ASSERT_EQ(Run().exit_code, 0);
  const std::string with = ReadFile(Result("trajectory.tum"));
  ASSERT_TRUE(std::filesystem::exists(Result("view.ply")));
  ASSERT_EQ(Run({"--noview", "--overwrite"}).exit_code, 0);
  EXPECT_EQ(ReadFile(Result("trajectory.tum")), with);
  EXPECT_FALSE(std::filesystem::exists(Result("view.ply")));
}

TEST_F(TrajloRunTest, InspectWritesTheFactorGraphsOfWindowsAndAnEarlierOneGoes) {
  RoomRecording().Write(input());
  ASSERT_EQ(Run().exit_code, 0);
  const std::string without = ReadFile(Result("trajectory.tum"));
  EXPECT_FALSE(std::filesystem::exists(Result("windows")));
  ASSERT_EQ(Run({"--inspect=7", "--inspect=9-11", "--overwrite"}).exit_code, 0);
  EXPECT_EQ(ReadFile(Result("trajectory.tum")), without);
  const std::vector<std::string> names = {"000007", "000009", "000010", "000011"};
  for (const std::string& name : names) {
    const auto graph = nlohmann::json::parse(ReadFile(Result("windows/" + name + ".json")));
    EXPECT_EQ(graph["index"].get<int>(), std::stoi(name));
    EXPECT_GT(graph["cost"]["registration"].get<double>(), 0.0);
    EXPECT_EQ(graph["H"].size(), 6 * graph["poses"].size());
    EXPECT_THAT(ReadFile(Result("windows/" + name + ".ply")), HasSubstr("double kernel_weight"));
  }
  WriteFile(Result("windows/000001.txt"), "somebody's");
  WriteFile(Result("windows/000007_points.svg"), "drawn");
  const Outcome beyond = Run({"--inspect=100000", "--overwrite"});
  EXPECT_EQ(beyond.exit_code, 0);
  EXPECT_THAT(beyond.err, HasSubstr("there is no window 100000"));
  EXPECT_FALSE(std::filesystem::exists(Result("windows/000007.json")));
  EXPECT_FALSE(std::filesystem::exists(Result("windows/000007_points.svg")));
  EXPECT_TRUE(std::filesystem::exists(Result("windows/000001.txt")));
}

TEST_F(TrajloRunTest, TheWrittenConfigRepeatsTheRun) {
  RoomRecording().Write(input());
  ASSERT_EQ(
      Run({"--set=window.segments=3,map.voxel_size_m=0.7", "--solver=gauss_newton"}).exit_code, 0);
  const std::string first = ReadFile(Result("trajectory.tum"));
  const std::string config = ReadFile(Result("config.yaml"));
  WriteFile(temp_ / "again.yaml", config);
  ASSERT_EQ(Run({"--config=" + (temp_ / "again.yaml").string(), "--overwrite"}).exit_code, 0);
  EXPECT_EQ(ReadFile(Result("trajectory.tum")), first);
  EXPECT_EQ(ReadFile(Result("config.yaml")), config);
  EXPECT_EQ(RunJson()["solver"], "gauss_newton");
}

TEST_F(TrajloRunTest, RateSamplesEvenly) {
  RoomRecording().Write(input());
  ASSERT_EQ(Run({"--rate=100"}).exit_code, 0);
  const std::vector<StampedPose> poses = Trajectory();
  ASSERT_GT(poses.size(), 110u);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    EXPECT_EQ(poses[i].t_ns - poses[i - 1].t_ns, 10'000'000);
  }
}

TEST_F(TrajloRunTest, OnePosePerScan) {
  RoomRecording().Write(input());
  ASSERT_EQ(Run({"--at=scan-mid"}).exit_code, 0);
  const std::vector<StampedPose> mid = Trajectory();
  ASSERT_EQ(Run({"--at=scan-end", "--overwrite"}).exit_code, 0);
  const std::vector<StampedPose> end = Trajectory();
  ASSERT_EQ(mid.size(), 12u);
  ASSERT_EQ(end.size(), 12u);
  EXPECT_NEAR(1e-6 * static_cast<double>(end[3].t_ns - mid[3].t_ns), 50.0, 1.0);
}

TEST_F(TrajloRunTest, TwoLidarsAreMergedByTheirExtrinsics) {
  RoomRecording front, rear;
  rear.sensor_at = Eigen::Vector3d(-0.4, 0.1, 0.2);
  front.Write(temp_ / "in/lidar0");
  rear.Write(temp_ / "in/lidar1");
  const Outcome outcome =
      Run({"--set=sensor.T_body_lidar=[{}, {translation_m: [-0.4, 0.1, 0.2]}]"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(RunJson()["input"]["scans"]["read"], 24);
  const std::vector<StampedPose> poses = Trajectory();
  const double t = 1e-9 * static_cast<double>(poses.back().t_ns) - RoomRecording::kStart;
  EXPECT_NEAR(poses.back().T_world_body.t.x(), front.PositionX(t), 0.03);
}

TEST_F(TrajloRunTest, QuietPrintsNothingWhenAllIsWell) {
  RoomRecording().Write(input());
  const Outcome outcome = Run({"--quiet"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(TrajloRunTest, StampsAreBesideTheConfigurationOrBelowTheCurrentFolder) {
  RoomRecording room;
  room.scans = 4;
  room.Write(temp_ / "in");
  fs::create_directories(temp_ / "mine");
  fs::rename(temp_ / "in/timestamps.txt", temp_ / "mine/stamps.txt");
  WriteFile(temp_ / "mine/my.yaml", "input: {stamps_file: stamps.txt}\n");
  const std::string whole = (temp_ / "mine/stamps.txt").string();
  const auto run_with = [&](const std::string& flag) {
    const Outcome outcome = Run({flag, "--overwrite"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string config = ReadFile(Result("config.yaml")), key = "stamps_file: \"";
    const std::size_t begin = config.find(key) + key.size();
    const fs::path used = config.substr(begin, config.find('"', begin) - begin);
    EXPECT_TRUE(used.is_absolute() && fs::equivalent(used, whole)) << used;
  };
  run_with("--config=" + (temp_ / "mine/my.yaml").string());
  run_with("--config=" + fs::relative(temp_ / "mine/my.yaml").string());
  run_with("--set=input.stamps_file=" + fs::relative(whole).string());
}

}  // namespace
}  // namespace trajlo::testing
