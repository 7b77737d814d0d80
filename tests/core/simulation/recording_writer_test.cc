// SPDX-License-Identifier: MIT
// Reads back with a few lines of its own, so that a shared mistake of writer and reader shows.
#include "core/simulation/recording_writer.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "core/io/messages/pose_decoder.h"
#include "core/io/ros1/ros1_bag_reader.h"
#include "core/simulation/point_time.h"
#include "tests/core/simulation/hollow_cube.h"
#include "tests/support/temp_folder.h"

namespace trajlo::simulation {
namespace {

namespace fs = std::filesystem;

std::string Contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<std::string> Lines(const fs::path& path) {
  std::istringstream stream(Contents(path));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

SE3 SlowTurn(double t) { return {so3::Exp({0.0, 0.0, 0.3 * t}), {0.5 * t, 0.0, 0.0}}; }

class RecordingWriterTest : public ::testing::Test {
 protected:
  RecordingWriterTest() {
    scenario_.name = "cube";
    scenario_.description = "a cube";
    scenario_.rig = {MakeLidar("os1_16", {so3::Exp({0.0, 0.1, 0.0}), {0.1, 0.2, 0.3}})};
    scenario_.duration_s = 0.5;
    scenario_.start_time_ns = 1'700'000'000'250'000'000;
  }

  std::vector<SimulatedScan> Record(const std::optional<BagFormat>& bag = {}) {
    const Simulator simulator(scenario_, MakeHollowCube(), SlowTurn);
    RecordingWriter writer(simulator, directory_, bag);
    std::vector<SimulatedScan> scans;
    SimulateScans(simulator, 0, [&](const SimulatedScan& scan) {
      writer.Write(scan);
      scans.push_back(scan);
    });
    writer.Finish();
    EXPECT_EQ(writer.scans(), static_cast<std::int64_t>(scans.size()));
    return scans;
  }

  trajlo::testing::TempFolder folder_;
  fs::path directory_ = folder_ / "recording";
  Scenario scenario_;
};

TEST_F(RecordingWriterTest, APcdFileHasItsHeaderAndTwentyBytesAPoint) {
  const std::vector<SimulatedScan> scans = Record();
  const LidarScan& scan = scans[3].scan;
  const std::string text = Contents(directory_ / "scans" / "000003.pcd");
  const std::string n = std::to_string(scan.points.size());
  const std::string header =
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z intensity time\n"
      "SIZE 4 4 4 4 4\nTYPE F F F F F\nCOUNT 1 1 1 1 1\nWIDTH " +
      n + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + n + "\nDATA binary\n";
  ASSERT_EQ(text.substr(0, header.size()), header);
  ASSERT_EQ(text.size(), header.size() + 20 * scan.points.size());
  for (std::size_t i = 0; i < scan.points.size(); i += 97) {
    float fields[5];
    std::memcpy(fields, text.data() + header.size() + 20 * i, sizeof(fields));
    EXPECT_EQ(fields[0], scan.points[i].xyz_m.x());
    EXPECT_EQ(fields[2], scan.points[i].xyz_m.z());
    EXPECT_EQ(fields[3], scan.points[i].intensity);
    const double offset_s = 1e-9 * static_cast<double>(scan.points[i].t_ns - scan.stamp_ns);
    EXPECT_NEAR(fields[4], offset_s, 1e-8);
  }
}

TEST_F(RecordingWriterTest, StampsAndTruthAreExactToTheNanosecond) {
  const std::vector<SimulatedScan> scans = Record();
  const std::vector<std::string> stamps = Lines(directory_ / "timestamps.txt");
  ASSERT_EQ(stamps.size(), 5U);
  EXPECT_EQ(stamps[0], "1700000000.250000000");
  EXPECT_EQ(stamps[4], "1700000000.650000000");
  const std::vector<std::string> truth = Lines(directory_ / "truth.tum");
  ASSERT_EQ(truth.size(), 501U);
  std::istringstream line(truth[250]);
  std::string t;
  double x, y, z, qx, qy, qz, qw;
  ASSERT_TRUE(line >> t >> x >> y >> z >> qx >> qy >> qz >> qw);
  EXPECT_EQ(t, "1700000000.500000000");
  EXPECT_LT(Minus({Eigen::Quaterniond(qw, qx, qy, qz), {x, y, z}}, SlowTurn(0.25)).norm(), 1e-8);
}

TEST_F(RecordingWriterTest, WithEndOfSweepStampsTheOffsetsStillCountFromTheStart) {
  scenario_.faults.end_of_sweep_stamps = true;
  Record();
  EXPECT_EQ(Lines(directory_ / "timestamps.txt")[0], "1700000000.350000000");
  const std::string text = Contents(directory_ / "scans" / "000000.pcd");
  float first_time;
  std::memcpy(&first_time, text.data() + text.find("DATA binary\n") + 12 + 16, sizeof(float));
  EXPECT_GE(first_time, 0.0F);
  EXPECT_LT(first_time, 0.001F);
}

TEST_F(RecordingWriterTest, ARigGetsAFolderForEachLidar) {
  scenario_.rig.push_back(MakeLidar("mid70"));
  Record();
  EXPECT_EQ(Lines(directory_ / "lidar0" / "timestamps.txt").size(), 5U);
  EXPECT_EQ(Lines(directory_ / "lidar1" / "timestamps.txt").size(), 5U);
  EXPECT_TRUE(fs::exists(directory_ / "lidar1" / "scans" / "000004.pcd"));
  EXPECT_TRUE(fs::exists(directory_ / "truth.tum"));
  EXPECT_FALSE(fs::exists(directory_ / "scans"));
}

TEST_F(RecordingWriterTest, MotionCorrectedScansAreWrittenAsKittiHasThem) {
  scenario_.motion_corrected = true;
  const std::vector<SimulatedScan> scans = Record();
  EXPECT_EQ(fs::file_size(directory_ / "velodyne" / "000002.bin"),
            16 * scans[2].scan.points.size());
  const std::vector<std::string> times = Lines(directory_ / "times.txt");
  ASSERT_EQ(times.size(), 5U);
  EXPECT_EQ(times[0], "0.050000000");
  const std::vector<std::string> poses = Lines(directory_ / "poses.txt");
  ASSERT_EQ(poses.size(), 5U);
  EXPECT_EQ(poses[0].substr(0, 2), "1 ");
  std::istringstream line(poses[4]);
  Eigen::Matrix<double, 3, 4, Eigen::RowMajor> pose;
  for (int i = 0; i < 12; ++i) line >> pose.data()[i];
  const SE3& T_body_lidar = scenario_.rig[0].T_body_lidar;
  const SE3 expected = (SlowTurn(0.05) * T_body_lidar).Inverse() * SlowTurn(0.45) * T_body_lidar;
  EXPECT_LT((pose.leftCols<3>() - expected.q.toRotationMatrix()).norm(), 1e-9);
  EXPECT_LT((pose.col(3) - expected.t).norm(), 1e-9);
}

TEST_F(RecordingWriterTest, TheScenarioFileIsYamlWithTheTrueExtrinsics) {
  scenario_.description = "a \"quoted\" cube";
  Record();
  const YAML::Node yaml = YAML::LoadFile((directory_ / "scenario.yaml").string());
  EXPECT_EQ(yaml["name"].as<std::string>(), "cube");
  EXPECT_EQ(yaml["duration_s"].as<double>(), 0.5);
  EXPECT_EQ(yaml["motion"]["kind"].as<std::string>(), "walk");
  EXPECT_EQ(yaml["lidar0"]["sensor"].as<std::string>(), "os1_16");
  const auto pose = yaml["lidar0"]["T_body_lidar"].as<std::vector<double>>();
  ASSERT_EQ(pose.size(), 7U);
  EXPECT_EQ(pose[1], 0.2);
  const auto matrix = yaml["lidar0"]["T_body_lidar_matrix"].as<std::vector<double>>();
  ASSERT_EQ(matrix.size(), 16U);
  EXPECT_NEAR(matrix[2], std::sin(0.1), 1e-9);
  EXPECT_EQ(matrix[11], 0.3);
  const YAML::Node rig = YAML::LoadFile((directory_ / "rig.yaml").string());
  const YAML::Node extrinsic = rig["sensor"]["T_body_lidar"][0];
  EXPECT_EQ(extrinsic["translation_m"].as<std::vector<double>>()[1], 0.2);
  EXPECT_EQ(extrinsic["rotation"].as<std::vector<double>>()[1], std::sin(0.05));
}

TEST_F(RecordingWriterTest, PointTimesSurviveSecondsOfFloat32) {
  for (const SimulatedScan& simulated : Record()) {
    for (const LidarPoint& point : simulated.scan.points) {
      const std::int64_t offset_ns = point.t_ns - simulated.sweep_start_ns;
      ASSERT_EQ(StorableOffsetNs(offset_ns), offset_ns);
    }
  }
}

TEST(StorableOffsetNs, IsCloseAndDoesNotMoveTwice) {
  for (std::int64_t offset_ns = 0; offset_ns < 100'000'000; offset_ns += 9'973) {
    const std::int64_t stored_ns = StorableOffsetNs(offset_ns);
    ASSERT_LE(std::abs(stored_ns - offset_ns), 4);
    ASSERT_EQ(StorableOffsetNs(stored_ns), stored_ns);
  }
}

TEST_F(RecordingWriterTest, ABagHasPointsTruthAndTopicsAndNoFolderOfScans) {
  scenario_.rig.push_back(MakeLidar("avia"));
  const std::vector<SimulatedScan> scans = Record(BagFormat());
  EXPECT_FALSE(fs::exists(directory_ / "scans"));
  EXPECT_FALSE(fs::exists(directory_ / "lidar0"));
  EXPECT_TRUE(fs::exists(directory_ / "truth.tum"));
  const YAML::Node rig = YAML::LoadFile((directory_ / "rig.yaml").string());
  EXPECT_EQ(rig["input"]["topics"][0].as<std::string>(), "/os_cloud_node/points");
  EXPECT_EQ(rig["input"]["topics"][1].as<std::string>(), "/livox/lidar");
  Ros1BagReader bag(directory_ / "recording.bag");
  std::size_t clouds = 0;
  std::int64_t truth_ns = scenario_.start_time_ns, before_ns = 0;
  RawMessage message;
  while (bag.Next(&message)) {
    EXPECT_GE(message.recorded_ns, before_ns);
    before_ns = message.recorded_ns;
    const Topic& topic = bag.topics()[message.topic];
    if (topic.name != "/truth") {
      ++clouds;
      continue;
    }
    const auto pose = DecodePose(topic.type, topic.encoding, message.bytes.view());
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->t_ns, truth_ns);
    const double t_s = 1e-9 * static_cast<double>(truth_ns - scenario_.start_time_ns);
    EXPECT_LT(Minus(pose->T_world_body, SlowTurn(t_s)).norm(), 1e-12);
    truth_ns += 1'000'000;
  }
  EXPECT_EQ(clouds, scans.size());
  EXPECT_EQ(truth_ns, scenario_.start_time_ns + 501'000'000);
}

TEST_F(RecordingWriterTest, MotionCorrectedScansGoIntoNoBag) {
  scenario_.motion_corrected = true;
  EXPECT_THROW(Record(BagFormat()), std::invalid_argument);
}

TEST_F(RecordingWriterTest, ThePictureShowsSceneAndPath) {
  Record();
  const std::string svg = Contents(directory_ / "picture.svg");
  EXPECT_EQ(svg.substr(0, 4), "<svg");
  EXPECT_NE(svg.find("<polyline"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST_F(RecordingWriterTest, AFolderThatCannotBeMadeIsNamed) {
  directory_ = folder_ / "trajlo_not_a_folder";
  std::ofstream(directory_) << "x";
  try {
    Record();
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("trajlo_not_a_folder"), std::string::npos);
  }
}

}  // namespace
}  // namespace trajlo::simulation
