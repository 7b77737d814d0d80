// SPDX-License-Identifier: MIT
#include "core/io/inspection/run_advice.h"

#include <gmock/gmock.h>

#include "tests/core/io/inspection/inspection_testing.h"

namespace trajlo {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using trajlo::testing::Cloud;

RecordingInspection Recording(std::vector<CloudInspection> clouds) {
  RecordingInspection recording;
  recording.path = "my recording.bag";
  recording.clouds = std::move(clouds);
  return recording;
}

TEST(AdviseRun, TellsTheSensorByItsFields) {
  const auto config = [](std::vector<FieldDescription> fields) {
    return AdviseRun(Recording({Cloud("/points", std::move(fields))})).config;
  };
  EXPECT_EQ(config({{"t", "uint32", 20}, {"reflectivity", "uint16", 24}}), "ouster");
  EXPECT_EQ(config({{"offset_time", "uint32", 0}}), "livox");
  EXPECT_EQ(config({{"x", "float32", 0}}), "");
}

TEST(AdviseRun, TakesALidarForAHesaiWhereANameSaysSo) {
  // RoboSense's driver writes the same fields as Hesai's.
  CloudInspection cloud =
      Cloud("/rslidar_points", {{"ring", "uint16", 16}, {"timestamp", "float64", 18}});
  cloud.frame_ids = {"rslidar"};
  const RunAdvice other = AdviseRun(Recording({cloud}));
  EXPECT_EQ(other.config, "");
  EXPECT_THAT(other.command, Not(HasSubstr(" -c ")));
  for (const auto& [topic, frame] : {std::pair{"/hesai/pandar", ""},
                                     {"/lidar_points", "hesai_lidar"},
                                     {"/lidar_points", "PandarXT-32"}}) {
    cloud.topic = topic;
    cloud.frame_ids = {frame};
    const RunAdvice advice = AdviseRun(Recording({cloud}));
    EXPECT_EQ(advice.config, "hesai") << topic << frame;
    EXPECT_THAT(advice.remarks, Contains(HasSubstr("leave out -c hesai if")));
  }
  cloud.fields.pop_back();
  EXPECT_EQ(AdviseRun(Recording({cloud})).config, "") << "not as its driver writes points";
}

/// A cloud with the fields that Velodyne's drivers write, `time` in seconds within the sweep.
CloudInspection LikeVelodyne() {
  CloudInspection cloud = Cloud("/points", {{"ring", "uint16", 16}, {"time", "float32", 18}});
  cloud.convention.field = "time";
  cloud.convention.unit = TimeUnit::kSeconds;
  return cloud;
}

TEST(AdviseRun, TakesNoOtherLidarForAVelodyneThatHasAFieldCalledTime) {
  CloudInspection cloud = LikeVelodyne();
  for (const TimeOrigin origin :
       {TimeOrigin::kSweepStart, TimeOrigin::kStamp, TimeOrigin::kSweepEnd}) {
    cloud.convention.origin = origin;
    const RunAdvice advice = AdviseRun(Recording({cloud}));
    EXPECT_EQ(advice.config, "velodyne");
    EXPECT_THAT(advice.remarks, Contains(HasSubstr("leave out -c velodyne if it is another")));
  }
  cloud.convention.origin = TimeOrigin::kAbsolute;
  EXPECT_EQ(AdviseRun(Recording({cloud})).config, "");
  cloud = LikeVelodyne();
  cloud.convention.unit = TimeUnit::kMicroseconds;
  EXPECT_EQ(AdviseRun(Recording({cloud})).config, "");
  cloud = LikeVelodyne();
  cloud.convention = {};  // None could be decided.
  EXPECT_EQ(AdviseRun(Recording({cloud})).config, "");
  cloud = LikeVelodyne();
  cloud.points.rings = PointSummary::Rings{32, 0, 31};
  EXPECT_EQ(AdviseRun(Recording({cloud})).config, "velodyne");
  cloud.points.rings = PointSummary::Rings{64, 0, 63};
  EXPECT_EQ(AdviseRun(Recording({cloud})).config, "");
}

/// A folder of .bin scans without times, seen by a LiDAR of this field of view.
RecordingInspection BinFolder(const std::string& folder, double low_deg, double high_deg) {
  CloudInspection cloud = Cloud(folder, {});
  cloud.type = ".bin files";
  cloud.convention = {};
  cloud.points.elevation_1_deg = low_deg;
  cloud.points.elevation_99_deg = high_deg;
  return Recording({cloud});
}

TEST(AdviseRun, TiltsTheRaysOfKittiOnlyAndSaysSo) {
  for (const char* folder : {"sequences/00/velodyne", "drive/velodyne_points/data"}) {
    const RunAdvice kitti = AdviseRun(BinFolder(folder, -23.2, 3.1));
    EXPECT_EQ(kitti.config, "kitti");
    EXPECT_THAT(kitti.remarks, Contains(HasSubstr("turns every ray up by 0.205 degrees")));
  }
  for (const RecordingInspection& other :
       {BinFolder("sequences/00/clouds", -23.2, 3.1), BinFolder("velodyne", -30.0, 10.0),
        BinFolder("velodyne", -15.0, 14.0), BinFolder("velodyne", -24.8, 2.0)}) {
    const RunAdvice advice = AdviseRun(other);
    EXPECT_EQ(advice.config, "");
    EXPECT_THAT(advice.remarks, Contains(HasSubstr("--set input.point_time=none")));
  }
}

TEST(AdviseRun, QuotesForAShellAndSaysWhatItDoesNotKnow) {
  const RunAdvice one = AdviseRun(Recording({Cloud("/points", {})}));
  EXPECT_EQ(one.command, "trajlo_run 'my recording.bag' -o result");
  EXPECT_THAT(one.remarks, Contains(HasSubstr("sensor.T_body_lidar")));
  const RunAdvice two = AdviseRun(Recording({Cloud("/a", {}), Cloud("/b", {})}));
  EXPECT_THAT(two.command, HasSubstr(R"(--set 'input.topics=["/a", "/b"]')"));
  EXPECT_THAT(two.remarks, Contains(HasSubstr("where the LiDARs sit is not known")));
  EXPECT_THAT(two.remarks, Contains(HasSubstr("--set input.topics=/a")));
}

TEST(AdviseRun, TakesTheExtrinsicsThatLieInTheRecordingsFolder) {
  RecordingInspection recording = Recording({Cloud("/a", {}), Cloud("/b", {})});
  recording.path = "simulated";
  recording.rig_config = "simulated/rig.yaml";
  const RunAdvice advice = AdviseRun(recording);
  EXPECT_THAT(advice.command, HasSubstr(" -c simulated/rig.yaml "));
  EXPECT_THAT(advice.remarks, IsEmpty());
}

TEST(AdviseRun, KnowsDatasetsByTheirTopicsAndContradictsThemByEvidence) {
  std::vector<CloudInspection> clouds = {Cloud("/os1_cloud_node2/points", {}),
                                         Cloud("/os1_cloud_node1/points", {})};
  const RunAdvice advice = AdviseRun(Recording(clouds));
  EXPECT_EQ(advice.config, "ntu_viral");
  // The order of the config's extrinsics, not that of the bag.
  EXPECT_THAT(advice.command,
              HasSubstr(R"(["/os1_cloud_node1/points", "/os1_cloud_node2/points"])"));
  EXPECT_THAT(advice.command, Not(HasSubstr("stamp_at")));
  EXPECT_THAT(advice.remarks, ::testing::ElementsAre(HasSubstr("topics are those of NTU VIRAL")));
  clouds[0].convention.stamp_at = StampAt::kStart;
  const RunAdvice contradicted = AdviseRun(Recording(clouds));
  EXPECT_THAT(contradicted.command, HasSubstr("input.stamp_at=start"));
  EXPECT_THAT(contradicted.remarks, Contains(HasSubstr("check input.stamp_at")));
  // A guess contradicts nothing.
  for (CloudInspection& cloud : clouds) {
    cloud.convention.stamp_at = StampAt::kStart;
    cloud.convention.stamp_at_is_assumed = true;
  }
  const RunAdvice assumed = AdviseRun(Recording(clouds));
  EXPECT_THAT(assumed.command, Not(HasSubstr("stamp_at")));
  EXPECT_THAT(assumed.remarks, Not(Contains(HasSubstr("by the evidence"))));
}

TEST(AdviseRun, SaysThatTheExtrinsicsAreThoseOfTheDatasetsRig) {
  RecordingInspection recording =
      Recording({Cloud("/os1_cloud_node1/points", {}), Cloud("/os1_cloud_node2/points", {})});
  EXPECT_THAT(AdviseRun(recording).remarks,
              Contains(::testing::AllOf(HasSubstr("topics are those of NTU VIRAL"),
                                        HasSubstr("sit as on that rig"),
                                        HasSubstr("sensor.T_body_lidar"))));
  recording.rig_config = "in/rig.yaml";
  EXPECT_THAT(AdviseRun(recording).remarks, Not(Contains(HasSubstr("that rig"))));
}

TEST(AdviseRun, LeavesOutWhatAnotherOdometryHasRegistered) {
  CloudInspection raw = Cloud("/points", {}), registered = Cloud("/cloud_registered", {});
  raw.frame_ids = {"velodyne"};
  registered.frame_ids = {"camera_init"};
  const RunAdvice advice = AdviseRun(Recording({registered, raw}));
  EXPECT_THAT(advice.command, HasSubstr(R"(input.topics=["/points"])"));
  EXPECT_THAT(AdviseRun(Recording({registered})).command, HasSubstr("trajlo_run"));
}

TEST(AdviseRun, TellsOfTwoCloudsInOneFrame) {
  CloudInspection raw = Cloud("/points", {}), filtered = Cloud("/points_filtered", {});
  raw.frame_ids = filtered.frame_ids = {"velodyne"};
  EXPECT_THAT(AdviseRun(Recording({raw, filtered})).remarks,
              Contains(HasSubstr("two clouds of one LiDAR")));
  filtered.frame_ids = {"velodyne_rear"};
  EXPECT_THAT(AdviseRun(Recording({raw, filtered})).remarks,
              Not(Contains(HasSubstr("two clouds of one LiDAR"))));
}

TEST(AdviseRun, WithoutCloudsThereIsNoCommand) { EXPECT_EQ(AdviseRun(Recording({})).command, ""); }

}  // namespace
}  // namespace trajlo
