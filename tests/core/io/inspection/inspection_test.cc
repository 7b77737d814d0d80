// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "core/io/inspection/findings.h"
#include "core/io/inspection/point_summary.h"
#include "core/io/inspection/run_advice.h"
#include "core/io/inspection/stamp_summary.h"
#include "core/io/inspection/sweep_times.h"

namespace trajlo {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr std::int64_t kMs = 1'000'000;

std::vector<std::int64_t> Every100Ms(int count) {
  std::vector<std::int64_t> t_ns;
  for (int i = 0; i < count; ++i) t_ns.push_back(1'000'000 * kMs + i * 100 * kMs);
  return t_ns;
}

TEST(StampSummary, RegularStampsHaveNothingToReport) {
  const StampSummary stamps = SummariseStamps(Every100Ms(20), {});
  EXPECT_EQ(stamps.count, 20u);
  EXPECT_DOUBLE_EQ(stamps.period_s, 0.1);
  EXPECT_LT(stamps.jitter_s, 1e-9);
  EXPECT_THAT(stamps.gaps, IsEmpty());
  EXPECT_EQ(stamps.duplicates + stamps.steps_back + stamps.missing, 0u);
  EXPECT_FALSE(stamps.recorded_after_s);
}

TEST(StampSummary, GapsSayWhereHowLongAndHowManyScansAreMissing) {
  std::vector<std::int64_t> t_ns = Every100Ms(20);
  t_ns.erase(t_ns.begin() + 5, t_ns.begin() + 8);
  const StampSummary stamps = SummariseStamps(t_ns, {});
  ASSERT_EQ(stamps.gaps.size(), 1u);
  EXPECT_EQ(stamps.gaps[0].after_ns, 1'000'400 * kMs);
  EXPECT_EQ(stamps.gaps[0].length_ns, 400 * kMs);
  EXPECT_EQ(stamps.missing, 3u);
}

TEST(StampSummary, RepeatedStampsAndStepsBackAreToldApart) {
  std::vector<std::int64_t> t_ns = Every100Ms(20);
  t_ns[7] = t_ns[6];
  t_ns[12] = t_ns[11] - 20 * kMs;
  const StampSummary stamps = SummariseStamps(t_ns, {});
  EXPECT_EQ(stamps.duplicates, 1u);
  EXPECT_EQ(stamps.first_duplicate_ns, t_ns[7]);
  EXPECT_EQ(stamps.steps_back, 1u);
  EXPECT_EQ(stamps.first_step_back_ns, t_ns[12]);
  EXPECT_NEAR(stamps.largest_step_back_s, 0.02, 1e-12);
}

TEST(StampSummary, JitterIsTheRootMeanSquareOfOrdinarySteps) {
  std::vector<std::int64_t> t_ns = Every100Ms(21);
  // Steps of 100, 101, 99, 100, ...: two of five are off by 1 ms.
  for (std::size_t i = 2; i < t_ns.size(); i += 5) t_ns[i] += kMs;
  const StampSummary stamps = SummariseStamps(t_ns, {});
  EXPECT_NEAR(stamps.jitter_s, 1e-3 * std::sqrt(0.4), 1e-9);
  EXPECT_NEAR(stamps.largest_deviation_s, 1e-3, 1e-9);
}

TEST(StampSummary, TheDelayOfTheRecorderIsGivenWithItsExtremes) {
  const std::vector<std::int64_t> t_ns = Every100Ms(3);
  const StampSummary stamps =
      SummariseStamps(t_ns, {t_ns[0] + 5 * kMs, t_ns[1] + 1 * kMs, t_ns[2] + 9 * kMs});
  ASSERT_TRUE(stamps.recorded_after_s);
  EXPECT_NEAR(stamps.recorded_after_s->least, 0.001, 1e-12);
  EXPECT_NEAR(stamps.recorded_after_s->median, 0.005, 1e-12);
  EXPECT_NEAR(stamps.recorded_after_s->most, 0.009, 1e-12);
}

LidarScan ScanOf(const std::vector<Eigen::Vector3f>& points) {
  LidarScan scan;
  for (const Eigen::Vector3f& point : points) scan.points.push_back({point, 0.0F, 0});
  return scan;
}

TEST(PointCounter, CountsWhatIsNoReturnAndMeasuresTheRest) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  std::vector<Eigen::Vector3f> points = {{kNan, 0, 0}, {0, 0, 0}};
  for (int i = 1; i <= 200; ++i) points.emplace_back(0.0F, 0.1F * static_cast<float>(i), 0.0F);
  PointCounter counter;
  counter.Add({}, ScanOf(points));
  counter.Add({}, ScanOf({}));
  const PointSummary summary = counter.Summarise();
  EXPECT_EQ(summary.total, 202u);
  EXPECT_EQ(summary.not_finite, 1u);
  EXPECT_EQ(summary.at_origin, 1u);
  EXPECT_EQ(summary.empty_messages, 1u);
  EXPECT_EQ(summary.fewest, 0u);
  EXPECT_EQ(summary.most, 202u);
  EXPECT_NEAR(summary.range_min_m, 0.1, 1e-6);
  EXPECT_NEAR(summary.range_median_m, 10.0, 0.02);
  EXPECT_NEAR(summary.range_99_m, 19.8, 0.02);
  EXPECT_NEAR(summary.range_max_m, 20.0, 1e-5);
  EXPECT_FALSE(summary.rings);
}

TEST(PointCounter, RangesBeyondTheHistogramDoNotBreakIt) {
  PointCounter counter;
  counter.Add({}, ScanOf({{1e30F, 0, 0}, {1e-3F, 0, 0}}));
  const PointSummary summary = counter.Summarise();
  EXPECT_NEAR(summary.range_min_m, 1e-3, 1e-9);
  EXPECT_GT(summary.range_max_m, 9e29);
  EXPECT_TRUE(std::isfinite(summary.range_99_m));
}

/// A sweep of 90 ms that begins `phase_ns` after an even 100 ms.
LidarScan Sweep(int index, std::int64_t phase_ns) {
  LidarScan scan;
  scan.stamp_ns = 1'000'000 * kMs + index * 100 * kMs + phase_ns;
  for (int i = 0; i < 10; ++i) {
    scan.points.push_back({{1, 0, 0}, 0.0F, scan.stamp_ns + i * 10 * kMs});
  }
  return scan;
}

TEST(SweepTimes, SaysHowSweepsLieToTheirStampsAndToEachOther) {
  SweepTimes sweeps;
  for (int i = 0; i < 5; ++i) sweeps.Add(Sweep(i, 0), 0);
  const auto summary = sweeps.Summarise(0.1);
  ASSERT_TRUE(summary);
  EXPECT_NEAR(summary->span_s, 0.09, 1e-12);
  EXPECT_NEAR(summary->pause_s, 0.01, 1e-12);
  EXPECT_NEAR(summary->stamp_after_first_s, 0.0, 1e-12);
  EXPECT_NEAR(summary->stamp_after_last_s, -0.09, 1e-12);
}

TEST(SweepTimes, ScansWithoutTimesHaveNoSweeps) {
  SweepTimes sweeps;
  LidarScan scan = Sweep(0, 0);
  scan.has_point_times = false;
  sweeps.Add(scan, 0);
  EXPECT_FALSE(sweeps.Summarise(0.1));
}

TEST(PhaseOf, IsCountedFromTheSweepBefore) {
  SweepTimes first, second, early;
  for (int i = 0; i < 9; ++i) {
    first.Add(Sweep(i, 0), 0);
    second.Add(Sweep(i, 37 * kMs), 0);
    // About in step: it must not flip between the ends of the period.
    early.Add(Sweep(i, i % 2 == 0 ? -kMs : kMs), 0);
  }
  const auto phase = PhaseOf(second.begins_ns(), first.begins_ns(), 0.1);
  ASSERT_TRUE(phase);
  EXPECT_NEAR(phase->after_first_lidar_s, 0.037, 1e-9);
  EXPECT_NEAR(phase->spread_s, 0.0, 1e-9);
  const auto about_zero = PhaseOf(early.begins_ns(), first.begins_ns(), 0.1);
  ASSERT_TRUE(about_zero);
  EXPECT_NEAR(about_zero->spread_s, 0.002, 1e-9);
}

CloudInspection Cloud(const std::string& topic, std::vector<FieldDescription> fields) {
  CloudInspection cloud;
  cloud.topic = topic;
  cloud.type = "sensor_msgs/PointCloud2";
  cloud.fields = std::move(fields);
  cloud.messages_read = 10;
  cloud.points.total = 100'000;
  cloud.convention.field = "t";
  cloud.convention.stamp_at = StampAt::kEnd;
  return cloud;
}

RecordingInspection Recording(std::vector<CloudInspection> clouds) {
  RecordingInspection recording;
  recording.path = "my recording.bag";
  recording.clouds = std::move(clouds);
  return recording;
}

TEST(FindingsOf, AGoodRecordingHasNone) { EXPECT_THAT(FindingsOf(Cloud("/a", {})), IsEmpty()); }

TEST(FindingsOf, NamesWhatGoesWrong) {
  CloudInspection cloud = Cloud("/a", {});
  cloud.time_problem = "ambiguous point times";
  cloud.sweeps = SweepSummary{0.1, -0.05, 0.0, -0.1, 3};
  cloud.stamps.gaps = {{1'000'000'000, 400'000'000}, {2'000'000'000, 300'000'000}};
  cloud.stamps.missing = 5;
  cloud.stamps.duplicates = 2;
  cloud.stamps.first_duplicate_ns = 3'500'000'000;
  cloud.points.not_finite = 99'999;
  const std::vector<std::string> findings = FindingsOf(cloud);
  EXPECT_THAT(findings, Contains(HasSubstr("will refuse: ambiguous point times")));
  EXPECT_THAT(findings, Contains(HasSubstr("sweeps overlap by 0.05 s")));
  EXPECT_THAT(findings, Contains(HasSubstr("dropped: 3 points with impossible times")));
  EXPECT_THAT(findings, Contains(HasSubstr("2 gaps, about 5 scans are missing; the longest, 0.4 "
                                           "s, is after 1.000000000 s")));
  EXPECT_THAT(findings, Contains(HasSubstr("2 stamps repeat the one before, the first at 3.5")));
  EXPECT_THAT(findings, Contains(HasSubstr("only 0 returns a message")));
}

TEST(FindingsOf, CloudsThatAreRegisteredAlreadyAreNamed) {
  CloudInspection cloud = Cloud("/a", {});
  cloud.frame_ids = {"camera_init"};
  EXPECT_THAT(FindingsOf(cloud), Contains(HasSubstr("in frame 'camera_init'")));
}

TEST(FindingsOf, StampsThatMayBeInAnotherUnitAreNamed) {
  CloudInspection cloud = Cloud("/a", {});
  cloud.stamps.period_s = 100.0;
  EXPECT_THAT(FindingsOf(cloud), Contains(HasSubstr("stamps are 100 s apart: they may be in ms, "
                                                    "and must then be written in s")));
}

TEST(AdviseRun, TellsTheSensorByItsFields) {
  const auto config = [](std::vector<FieldDescription> fields) {
    return AdviseRun(Recording({Cloud("/points", std::move(fields))})).config;
  };
  EXPECT_EQ(config({{"t", "uint32", 20}, {"reflectivity", "uint16", 24}}), "ouster");
  EXPECT_EQ(config({{"timestamp", "float64", 16}}), "hesai");
  EXPECT_EQ(config({{"offset_time", "uint32", 0}}), "livox");
  EXPECT_EQ(config({{"x", "float32", 0}}), "");
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
