// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/odometry/segments/segment_scans.h"

namespace trajlo {
namespace {

LidarScan DiscreteScan(std::int64_t stamp_ms, int lidar = 0) {
  LidarScan scan = MakeScan(stamp_ms, 50, lidar);
  scan.has_point_times = false;
  for (LidarPoint& point : scan.points) point.t_ns = scan.stamp_ns;
  return scan;
}

TEST(Segmenter, MakesOneSegmentAScanWhereThereAreNoPointTimes) {
  Segmenter segmenter(SmallOptions());
  for (int i = 0; i < 3; ++i) segmenter.AddScan(DiscreteScan(100 * i));
  const auto clouds = Drain(&segmenter);
  ASSERT_EQ(clouds.size(), 3u);
  EXPECT_EQ(clouds[1].begin_ns, 0);
  EXPECT_EQ(clouds[1].end_ns, 100 * kMs);
  for (const SegmentPoint& point : clouds[1].map_points) EXPECT_EQ(point.alpha, 1.0F);
}

TEST(Segmenter, AfterAGapAScanWithoutPointTimesIsASegmentAsLongAsBefore) {
  Segmenter segmenter(SmallOptions());
  for (const int stamp_ms : {0, 100, 200, 1500, 1600}) segmenter.AddScan(DiscreteScan(stamp_ms));
  const auto clouds = Drain(&segmenter);
  ASSERT_EQ(clouds.size(), 6u);
  EXPECT_TRUE(clouds[3].is_gap);
  EXPECT_EQ(clouds[3].begin_ns, 200 * kMs);
  EXPECT_EQ(clouds[3].end_ns, 1400 * kMs);
  EXPECT_FALSE(clouds[4].is_gap);
  EXPECT_EQ(clouds[4].end_ns, 1500 * kMs);
  EXPECT_GT(clouds[4].map_points.size(), 10u);
}

TEST(Segmenter, ScansOfTwoLidarsWithoutPointTimesShareTheSegmentOfOneStamp) {
  SegmenterOptions options = SmallOptions();
  options.T_body_lidar = {SE3(), SE3()};
  for (const bool second_first : {false, true}) {
    Segmenter segmenter(options);
    std::vector<SegmentCloud> clouds;
    for (int i = 0; i < 5; ++i) {
      segmenter.AddScan(DiscreteScan(100 * i, second_first ? 1 : 0));
      segmenter.AddScan(DiscreteScan(100 * i, second_first ? 0 : 1));
      for (SegmentCloud& cloud : Drain(&segmenter)) clouds.push_back(std::move(cloud));
    }
    EXPECT_EQ(segmenter.counts().too_late, 0);
    ASSERT_EQ(clouds.size(), 5u);
    for (std::size_t k = 0; k < 5; ++k) {
      EXPECT_EQ(clouds[k].end_ns, 100 * static_cast<std::int64_t>(k) * kMs);
      bool first = false, second = false;
      for (const SegmentPoint& point : clouds[k].map_points) {
        EXPECT_EQ(point.alpha, 1.0F);
        (point.p_body_m.y() > 5 ? second : first) = true;
      }
      EXPECT_TRUE(first && second) << k;
    }
  }
}

TEST(Segmenter, AScanWithoutPointTimesThatComesBetweenTwoOthersOfAnotherLidarSplitsTheirSegment) {
  SegmenterOptions options = SmallOptions();
  options.T_body_lidar = {SE3(), SE3()};
  Segmenter segmenter(options);
  segmenter.AddScan(DiscreteScan(0, 0));
  segmenter.AddScan(DiscreteScan(100, 0));
  segmenter.AddScan(DiscreteScan(40, 1));
  segmenter.Finish();
  const auto clouds = Drain(&segmenter);
  ASSERT_EQ(clouds.size(), 3u);
  EXPECT_EQ(clouds[1].end_ns, 40 * kMs);
  EXPECT_GT(clouds[1].map_points.front().p_body_m.y(), 5.0F);
  EXPECT_EQ(clouds[2].end_ns, 100 * kMs);
  EXPECT_EQ(segmenter.counts().too_late, 0);
}

TEST(Segmenter, AScanWithoutPointTimesAmongOthersThatHaveThemIsAtItsStamp) {
  SegmenterOptions options = SmallOptions();
  options.T_body_lidar = {SE3(), SE3()};
  Segmenter segmenter(options);
  for (int t = 0; t < 500; t += 100) {
    segmenter.AddScan(MakeScan(t, 100, 0));
    segmenter.AddScan(DiscreteScan(t + 42, 1));
  }
  segmenter.Finish();
  EXPECT_EQ(segmenter.counts().too_late, 0);
  for (const SegmentCloud& cloud : Drain(&segmenter)) {
    for (const SegmentPoint& point : cloud.map_points) {
      if (point.p_body_m.y() < 5) continue;
      const double t_ms = 1e-6 * (static_cast<double>(cloud.begin_ns) +
                                  point.alpha * static_cast<double>(cloud.end_ns - cloud.begin_ns));
      EXPECT_NEAR(std::fmod(t_ms, 100.0), 42.0, 1e-3);
    }
  }
}
}  // namespace
}  // namespace trajlo
