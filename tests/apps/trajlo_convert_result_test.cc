// SPDX-License-Identifier: MIT
// A result of trajlo_run for other tools, as a user gets it.
#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

#include "core/io/point_file.h"
#include "core/io/recording/open_clouds.h"
#include "core/io/recording/open_recording.h"
#include "core/io/trajectory_file.h"
#include "core/io/trajectory_reader.h"
#include "tests/apps/command_testing.h"
#include "tests/support/room_recording.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

Outcome Convert(const std::vector<std::string>& arguments) {
  return CallProgram(TRAJLO_CONVERT, arguments);
}

/// Twelve scans of a room, and what trajlo_run made of them.
class TrajloConvertResult : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TempFolder>();
    RoomRecording().Write(*folder_ / "room");
    Run({});
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static void Run(const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"--input=" + Path("room"), "--output=" + Path("result"),
                                          "--overwrite", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome run = CallProgram(TRAJLO_RUN, arguments);
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  static std::string Path(const std::string& name) { return (*folder_ / name).string(); }

  /// Messages by topic.
  static std::map<std::string, std::size_t> CountMessages(const std::string& path) {
    const auto reader = OpenMessages(path);
    std::map<std::string, std::size_t> counts;
    RawMessage message;
    while (reader->Next(&message)) ++counts[reader->topics()[message.topic].name];
    EXPECT_FALSE(reader->report().damaged);
    return counts;
  }

  static std::unique_ptr<TempFolder> folder_;
};
std::unique_ptr<TempFolder> TrajloConvertResult::folder_;

/// The largest distance of a point in the world from the walls that it was measured on.
double LargestDistanceFromWalls(const std::vector<Eigen::Vector3d>& points) {
  double largest = 0.0;
  for (const Eigen::Vector3d& p : points) {
    const double walls[] = {p.x() + 6.0, 9.0 - p.x(), p.y() + 4.0,
                            5.0 - p.y(), p.z() + 1.5, 3.0 - p.z()};
    double nearest = 1e9;
    for (const double distance : walls) nearest = std::min(nearest, std::abs(distance));
    largest = std::max(largest, nearest);
  }
  return largest;
}

TEST_F(TrajloConvertResult, ABagOfAnyKindHasEverythingThatViewersShow) {
  const std::size_t poses = ReadTum(Path("result/trajectory.tum")).size();
  for (const char* name : {"a.mcap", "a.db3", "a.bag"}) {
    const Outcome outcome = Convert({Path("result"), Path(name)});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto counts = CountMessages(Path(name));
    EXPECT_EQ(counts.at("/path"), 1u);
    EXPECT_EQ(counts.at("/map"), 1u);
    EXPECT_EQ(counts.at("/tf_static"), 1u);
    EXPECT_EQ(counts.at("/odometry"), poses);
    EXPECT_EQ(counts.at("/points_deskewed"), 12u);
    EXPECT_GE(counts.at("/tf"), poses);
    EXPECT_EQ(counts.size(), 6u);
  }
}

TEST_F(TrajloConvertResult, WithoutScansAndMapTheRecordingIsNotNeeded) {
  fs::rename(Path("room"), Path("away"));
  const Outcome lean = Convert({Path("result"), Path("lean.mcap"), "--noscans", "--nomap"});
  const Outcome whole = Convert({Path("result"), Path("whole.mcap")});
  const Outcome elsewhere =
      Convert({Path("result"), Path("elsewhere.mcap"), "--recording=" + Path("away")});
  fs::rename(Path("away"), Path("room"));
  EXPECT_EQ(lean.exit_code, 0) << lean.err;
  EXPECT_EQ(CountMessages(Path("lean.mcap")).size(), 4u);
  EXPECT_EQ(whole.exit_code, 2);
  EXPECT_THAT(whole.err, AllOf(HasSubstr("is not there"), HasSubstr("--recording")));
  EXPECT_FALSE(fs::exists(Path("whole.mcap")));
  EXPECT_EQ(elsewhere.exit_code, 0) << elsewhere.err;
}

TEST_F(TrajloConvertResult, DeskewedScansLieOnTheWallsInEitherFrame) {
  for (const char* frame : {"body", "world"}) {
    for (const char* format : {"pcd", "ply"}) {
      const std::string out = Path(std::string(frame) + format);
      ASSERT_EQ(Convert({Path("result"), out, std::string("--frame=") + frame,
                         std::string("--scan_format=") + format})
                    .exit_code,
                0);
      const std::vector<StampedPose> poses = ReadTum(out + "/poses.tum");
      std::vector<std::string> warnings;
      const TrajectoryFile kitti =
          ReadTrajectory(out + "/poses.txt", TrajectoryFormat::kKitti, &warnings);
      ASSERT_EQ(poses.size(), 12u);
      ASSERT_EQ(kitti.T_world_body.size(), 12u);
      const auto recording = OpenRecording({out}, {});
      std::vector<Eigen::Vector3d> points;
      LidarScan scan;
      for (std::size_t i = 0; recording->Next(&scan); ++i) {
        EXPECT_FALSE(scan.has_point_times);
        EXPECT_EQ(scan.stamp_ns, poses.at(i).t_ns);
        EXPECT_NEAR((kitti.T_world_body[i].translation() - poses[i].T_world_body.t).norm(), 0.0,
                    1e-8);
        const bool is_body = std::string(frame) == "body";
        const SE3 T = is_body ? poses[i].T_world_body : SE3();
        for (const LidarPoint& point : scan.points) {
          points.push_back(T * point.xyz_m.cast<double>());
        }
      }
      // All but those behind the last pose.
      EXPECT_GT(points.size(), 11u * 16u * 360u);
      EXPECT_LT(LargestDistanceFromWalls(points), 0.03);
    }
  }
}

TEST_F(TrajloConvertResult, TheMapLiesOnTheWallsWithNormalsAcross) {
  ASSERT_EQ(Convert({Path("result"), Path("map.ply"), "--voxel_m=0.2"}).exit_code, 0);
  const PointTable table = ReadPointFile(Path("map.ply"));
  std::map<std::string, std::vector<double>> columns;
  for (const Column& column : table.columns) {
    std::vector<double>& values = columns[column.name];
    VisitColumn(table, column, 0, table.count,
                [&](std::size_t, auto value) { values.push_back(static_cast<double>(value)); });
  }
  std::vector<Eigen::Vector3d> points;
  std::size_t across = 0;
  for (std::size_t i = 0; i < table.count; ++i) {
    points.emplace_back(columns["x"][i], columns["y"][i], columns["z"][i]);
    const Eigen::Vector3d normal(columns["nx"][i], columns["ny"][i], columns["nz"][i]);
    across += normal.cwiseAbs().maxCoeff() > 0.99 ? 1 : 0;
  }
  EXPECT_GT(table.count, 1000u);
  // In corners a voxel's mean lies off both walls.
  EXPECT_LT(LargestDistanceFromWalls(points), 0.1);
  EXPECT_GT(across, table.count * 6 / 10);
  ASSERT_EQ(columns.count("red"), 1u);
}

TEST_F(TrajloConvertResult, PosesInKittisFormatHaveTheirTimesBesideThem) {
  ASSERT_EQ(Convert({Path("result"), Path("poses.txt")}).exit_code, 0);
  ASSERT_EQ(Convert({Path("result"), Path("poses.tum")}).exit_code, 0);
  EXPECT_EQ(ReadFile(Path("poses.tum")), ReadFile(Path("result/trajectory.tum")));
  std::vector<std::string> warnings;
  const TrajectoryFile kitti =
      ReadTrajectory(Path("poses.txt"), TrajectoryFormat::kKitti, &warnings);
  const std::vector<StampedPose> poses = ReadTum(Path("poses.tum"));
  ASSERT_EQ(kitti.T_world_body.size(), poses.size());
  std::istringstream times(ReadFile(Path("poses_times.txt")));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    double t_s = 0.0;
    times >> t_s;
    EXPECT_NEAR(t_s, 1e-9 * static_cast<double>(poses[i].t_ns), 1e-6);
    const SE3& T = poses[i].T_world_body;
    EXPECT_NEAR((kitti.T_world_body[i].translation() - T.t).norm(), 0.0, 1e-7);
    EXPECT_NEAR((kitti.T_world_body[i].linear() - T.q.toRotationMatrix()).norm(), 0.0, 1e-7);
  }
}

TEST_F(TrajloConvertResult, MistakesAreNamed) {
  EXPECT_EQ(Convert({Path("result"), Path("x.mcap"), "--start_s=1"}).exit_code, 1);
  EXPECT_EQ(Convert({Path("result"), Path("x.mcap"), "--compression=bz2"}).exit_code, 1);
  EXPECT_EQ(Convert({Path("result"), Path("x.mcap"), "--frame=lidar"}).exit_code, 1);
  EXPECT_EQ(Convert({Path("result"), Path("x.ply"), "--color=red"}).exit_code, 1);
  EXPECT_EQ(Convert({Path("result"), Path("x.ply"), "--voxel_m=-1"}).exit_code, 1);
  EXPECT_EQ(Convert({Path("result"), Path("x.las")}).exit_code, 1);
  EXPECT_EQ(Convert({Path("result"), Path("result")}).exit_code, 1);
  WriteFile(Path("there.mcap"), "precious");
  EXPECT_EQ(Convert({Path("result"), Path("there.mcap")}).exit_code, 5);
  EXPECT_EQ(ReadFile(Path("there.mcap")), "precious");
  EXPECT_EQ(Convert({Path("result"), "/dev/null/x.mcap"}).exit_code, 5);
  for (const char* there : {"kitti.txt", "kitti_times.txt"}) {
    WriteFile(Path(there), "precious");
    EXPECT_EQ(Convert({Path("result"), Path("kitti.txt")}).exit_code, 5) << there;
    EXPECT_EQ(ReadFile(Path(there)), "precious");
    fs::remove(Path(there));
    EXPECT_FALSE(fs::exists(Path("kitti.txt")) || fs::exists(Path("kitti_times.txt"))) << there;
  }
}

TEST_F(TrajloConvertResult, KeysThatAnOlderBuildWroteAreToldAndNotRefused) {
  fs::copy(Path("result"), Path("older"), fs::copy_options::recursive);
  WriteFile(Path("older/config.yaml"),
            ReadFile(Path("older/config.yaml")) + "weights: {kernel: huber}\nnoise_model: old\n");
  const Outcome outcome = Convert({Path("older"), Path("older.mcap")});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err,
              HasSubstr("what its config.yaml says of weights, noise_model is not used"));
  // A configuration that is given is another matter.
  EXPECT_EQ(
      Convert({Path("room"), Path("x.bag"), "--config=" + Path("older/config.yaml")}).exit_code, 1);
}

TEST_F(TrajloConvertResult, NeitherTheResultNorItsRecordingIsEverReplaced) {
  ASSERT_EQ(Convert({Path("room"), Path("room.bag")}).exit_code, 0);
  const std::string bag = ReadFile(Path("room.bag"));
  const std::string poses = ReadFile(Path("result/trajectory.tum"));
  const std::vector<std::vector<std::string>> mistakes = {
      {Path("room")},
      {Path("result/trajectory.tum")},
      {Path("room.bag"), "--recording=" + Path("room.bag")},
      {Path("room.bag"), "--recording=" + Path("room.bag"), "--noscans", "--nomap"},
  };
  for (std::vector<std::string> arguments : mistakes) {
    arguments.insert(arguments.begin(), {Path("result"), "--overwrite"});
    const Outcome outcome = Convert(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << arguments[2];
    EXPECT_THAT(outcome.err, HasSubstr("choose another output"));
  }
  EXPECT_TRUE(fs::exists(Path("room/scans/000011.pcd")));
  EXPECT_EQ(ReadFile(Path("room.bag")), bag);
  EXPECT_EQ(ReadFile(Path("result/trajectory.tum")), poses);
}

TEST_F(TrajloConvertResult, AnotherRecordingThanThatOfTheRunIsNoticed) {
  RoomRecording shorter;
  shorter.scans = 9;
  shorter.Write(Path("shorter"));
  const Outcome other = Convert({Path("result"), Path("s.ply"), "--recording=" + Path("shorter")});
  EXPECT_EQ(other.exit_code, 3);
  EXPECT_THAT(other.err, HasSubstr("9 scans were read, 12 when it was run"));
  // At another time.
  fs::create_directories(Path("later"));
  fs::copy(Path("room/scans"), Path("later/scans"));
  std::string stamps;
  for (int i = 0; i < 12; ++i) stamps += std::to_string(5000.0 + 0.1 * i) + "\n";
  WriteFile(Path("later/timestamps.txt"), stamps);
  const Outcome later = Convert({Path("result"), Path("l.ply"), "--recording=" + Path("later")});
  EXPECT_EQ(later.exit_code, 2);
  EXPECT_THAT(later.err, HasSubstr("lies within its trajectory"));
  EXPECT_FALSE(fs::exists(Path("l.ply")));
}

TEST_F(TrajloConvertResult, ARunThatDidNotEndWellIsWarnedOf) {
  fs::copy(Path("result"), Path("killed"), fs::copy_options::recursive);
  std::string summary = ReadFile(Path("killed/run.json"));
  const std::string entry = "\"reason\": \"ok\"";
  ASSERT_NE(summary.find(entry), std::string::npos);
  summary.replace(summary.find(entry), entry.size(), R"("reason": "running")");
  WriteFile(Path("killed/run.json"), summary);
  const Outcome outcome = Convert({Path("killed"), Path("killed.tum")});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("the run was killed or is still running"));
  EXPECT_EQ(Convert({Path("result"), Path("well.tum")}).err, "");
}

TEST_F(TrajloConvertResult, PosesFromWhereItGotLostAreLeftOutAndTheirPointsToo) {
  fs::copy(Path("result"), Path("lost"), fs::copy_options::recursive);
  std::string summary = ReadFile(Path("lost/run.json"));
  const std::string entry = "\"lost_at_s\": null";
  ASSERT_NE(summary.find(entry), std::string::npos);
  summary.replace(summary.find(entry), entry.size(), R"("lost_at_s": "1000.600000000")");
  WriteFile(Path("lost/run.json"), summary);
  const Outcome outcome = Convert({Path("lost"), Path("lost.mcap")});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("got lost at 1000.600000000 s"),
                                 HasSubstr("--keep_lost"), HasSubstr("after the trajectory")));
  EXPECT_EQ(CountMessages(Path("lost.mcap")).at("/points_deskewed"), 6u);
  ASSERT_EQ(Convert({Path("lost"), Path("kept.mcap"), "--keep_lost"}).exit_code, 0);
  EXPECT_EQ(CountMessages(Path("kept.mcap")).at("/points_deskewed"), 12u);
}

TEST_F(TrajloConvertResult, ARunWithPosesAtChosenTimesIsPlacedLessExactlyAndSaysSo) {
  Run({"--at=scan-end"});
  const Outcome outcome = Convert({Path("result"), Path("rate.ply")});
  Run({});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("placed less exactly"));
}

}  // namespace
}  // namespace trajlo::testing
