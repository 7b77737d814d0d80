// SPDX-License-Identifier: MIT
#include "core/odometry/segments/segmenter.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

#include "tests/core/odometry/segments/segment_scans.h"

namespace trajlo {
namespace {

TEST(Segmenter, HasNoHolesBetweenSegmentsAndTimesWithinThem) {
  Segmenter segmenter(SmallOptions());
  for (int t = 0; t < 1000; t += 100) segmenter.AddScan(MakeScan(t, 100));
  segmenter.Finish();
  const auto clouds = Drain(&segmenter);
  ASSERT_GT(clouds.size(), 30U);
  for (std::size_t k = 0; k < clouds.size(); ++k) {
    EXPECT_EQ(clouds[k].begin_ns, k > 0 ? clouds[k - 1].end_ns : 0);
    EXPECT_EQ(clouds[k].end_ns - clouds[k].begin_ns, 30 * kMs);
    for (const SegmentPoint& point : clouds[k].map_points) {
      EXPECT_GE(point.alpha, 0.0F);
      EXPECT_LT(point.alpha, 1.0F);
    }
  }
}

TEST(Segmenter, CorrectsTheClockOfALidarAndSaysByHowMuch) {
  Segmenter exact(SmallOptions()), late(SmallOptions());
  late.CorrectClocks({0.0, -0.004});
  for (int t = 0; t < 600; t += 100) {
    for (const int lidar : {0, 1}) {
      LidarScan scan = MakeScan(t, 100, lidar);
      exact.AddScan(scan);
      for (LidarPoint& point : scan.points) point.t_ns += lidar * 4 * kMs;
      late.AddScan(scan);
    }
  }
  exact.Finish();
  late.Finish();
  const auto expected = Drain(&exact), clouds = Drain(&late);
  ASSERT_EQ(clouds.size(), expected.size());
  for (std::size_t k = 0; k < clouds.size(); ++k) {
    EXPECT_EQ(clouds[k].begin_ns, expected[k].begin_ns);
    ASSERT_EQ(clouds[k].map_points.size(), expected[k].map_points.size());
    for (std::size_t i = 0; i < clouds[k].map_points.size(); ++i) {
      EXPECT_EQ(clouds[k].map_points[i].alpha, expected[k].map_points[i].alpha);
      EXPECT_EQ(clouds[k].map_points[i].p_body_m, expected[k].map_points[i].p_body_m);
    }
    ASSERT_EQ(clouds[k].corrections.size(), 2u);
    EXPECT_EQ(clouds[k].corrections[0].clock_s, 0.0);
    EXPECT_EQ(clouds[k].corrections[1].clock_s, -0.004);
  }
}

/// The stamp of such a scan is the time of a pose, which the other LiDARs share.
TEST(Segmenter, LeavesStampsOfScansWithoutPointTimes) {
  Segmenter segmenter(SmallOptions());
  segmenter.CorrectClocks({0.01});
  for (int t = 0; t < 300; t += 100) {
    LidarScan scan = MakeScan(t, 10);
    scan.has_point_times = false;
    segmenter.AddScan(scan);
  }
  segmenter.Finish();
  for (const SegmentCloud& cloud : Drain(&segmenter)) {
    EXPECT_EQ(cloud.end_ns % (100 * kMs), 0);
    EXPECT_EQ(cloud.corrections.at(0).clock_s, 0.0);
  }
}

TEST(Segmenter, CutsScansOfAnyLengthAtTheSameBoundariesAndLosesNoPoint) {
  std::vector<std::vector<SegmentCloud>> results;
  for (int scan_ms : {7, 50, 100, 400}) {
    Segmenter segmenter(SmallOptions());
    for (int t = 0; t < 2800; t += scan_ms) {
      segmenter.AddScan(MakeScan(t, std::min(scan_ms, 2800 - t)));
    }
    segmenter.Finish();
    results.push_back(Drain(&segmenter));
  }
  for (const auto& clouds : results) {
    ASSERT_GE(clouds.size(), 90u);
    ASSERT_EQ(clouds.size(), results[0].size());
    std::size_t points = 0;
    for (std::size_t k = 0; k < clouds.size(); ++k) {
      const SegmentCloud& cloud = clouds[k];
      EXPECT_EQ(cloud.begin_ns, k == 0 ? 0 : clouds[k - 1].end_ns);
      EXPECT_EQ(cloud.end_ns, results[0][k].end_ns);
      ASSERT_EQ(cloud.map_points.size(), results[0][k].map_points.size());
      points += cloud.map_points.size();
      for (std::size_t i = 0; i < cloud.map_points.size(); ++i) {
        const SegmentPoint& point = cloud.map_points[i];
        EXPECT_EQ(point.alpha, results[0][k].map_points[i].alpha);
        const double t_ms =
            1e-6 * (static_cast<double>(cloud.begin_ns) +
                    point.alpha * static_cast<double>(cloud.end_ns - cloud.begin_ns));
        EXPECT_NEAR(std::fmod(t_ms + 0.5, 100.0) - 0.5, point.p_body_m.x() - 5.0, 1e-3);
      }
    }
    EXPECT_EQ(points, 2800u);
  }
}

TEST(Segmenter, DropsAndCountsPointsThatCannotBeUsed) {
  LidarScan scan = MakeScan(0, 10);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  scan.points[0].xyz_m = {nan, 0, 0};
  scan.points[1].xyz_m = {0, inf, 0};
  scan.points[2].xyz_m = {0, 0, 0};
  scan.points[3].xyz_m = {0.1F, 0, 0};
  scan.points[4].xyz_m = {400, 0, 0};
  Segmenter segmenter(SmallOptions());
  segmenter.AddScan(scan);
  segmenter.Finish();
  EXPECT_EQ(segmenter.counts().received, 10);
  EXPECT_EQ(segmenter.counts().not_finite, 2);
  EXPECT_EQ(segmenter.counts().too_near, 2);
  EXPECT_EQ(segmenter.counts().too_far, 1);
  EXPECT_EQ(segmenter.counts().Kept(), 5);
}

TEST(Segmenter, KeepsTheFirstPointsThatAreFarEnoughBehindManyThatAreNot) {
  Segmenter segmenter(SmallOptions());
  int t_ms = 0;
  // A hand before the LiDAR for 1.25 s; the last scan sees past it from its middle on.
  for (; t_ms < 1250; t_ms += 50) {
    LidarScan scan = MakeScan(t_ms, 50);
    for (LidarPoint& point : scan.points) {
      if (t_ms > 0) point.xyz_m = {0.1F, 0, 0};
    }
    segmenter.AddScan(scan);
  }
  const std::int64_t before = segmenter.counts().Kept();
  LidarScan last = MakeScan(t_ms, 200);
  for (std::size_t i = 0; i < 100; ++i) last.points[i].xyz_m = {0.1F, 0, 0};
  segmenter.AddScan(last);
  EXPECT_EQ(segmenter.counts().wrong_time, 0);
  EXPECT_EQ(segmenter.counts().Kept() - before, 100);
}

TEST(Segmenter, MergesLidarsInTheBodyFrameAndWaitsForTheSlowerOne) {
  SegmenterOptions options = SmallOptions();
  options.T_body_lidar = {SE3(), SE3(Eigen::Quaterniond::Identity(), {0, 0, 100})};
  options.max_range_m = 1000;
  Segmenter segmenter(options);
  segmenter.AddScan(MakeScan(0, 200, 0));
  EXPECT_TRUE(Drain(&segmenter).empty()) << "the second LiDAR has not spoken yet";
  segmenter.AddScan(MakeScan(0, 150, 1));
  const auto clouds = Drain(&segmenter);
  ASSERT_EQ(clouds.size(), 4u) << "up to 120 ms: the segment that ends at 150 ms is open";
  bool first = false, second = false;
  for (const SegmentPoint& point : clouds[1].map_points) {
    (point.p_body_m.z() > 50 ? second : first) = true;
    EXPECT_EQ(point.lidar, point.p_body_m.z() > 50 ? 1 : 0);
  }
  EXPECT_TRUE(first && second);
  const std::vector<Eigen::Vector3d> origins = {{0, 0, 0}, {0, 0, 100}};
  EXPECT_EQ(clouds[1].lidar_origins_body_m, origins);
}

TEST(Segmenter, DoesNotWaitForeverForALidarThatNeverSpeaks) {
  SegmenterOptions options = SmallOptions();
  options.T_body_lidar = {SE3(), SE3()};
  Segmenter segmenter(options);
  for (int t = 0; t < 3000; t += 100) segmenter.AddScan(MakeScan(t, 100, 0));
  EXPECT_GT(Drain(&segmenter).size(), 70u);
}

TEST(Segmenter, GoesOnWithoutALidarThatFallsSilentAndTakesItInAgain) {
  SegmenterOptions options = SmallOptions();
  options.T_body_lidar = {SE3(), SE3()};
  Segmenter segmenter(options);
  std::vector<SegmentCloud> clouds;
  for (int t = 0; t < 6000; t += 100) {
    segmenter.AddScan(MakeScan(t, 100, 0));
    // The other one has half the rate.
    const bool speaks = t < 1000 || t >= 4000;
    if (speaks && t % 200 == 0) segmenter.AddScan(MakeScan(t, 100, 1));
    for (SegmentCloud& cloud : Drain(&segmenter)) clouds.push_back(std::move(cloud));
    if (t == 3900) {
      EXPECT_GT(clouds.back().end_ns, 3800 * kMs);
    }
  }
  segmenter.Finish();
  for (SegmentCloud& cloud : Drain(&segmenter)) clouds.push_back(std::move(cloud));
  // The scan with which it comes back: nobody waited for it.
  EXPECT_LE(segmenter.counts().too_late, 100);
  std::size_t from_first = 0, before = 0, meanwhile = 0, after = 0;
  for (const SegmentCloud& cloud : clouds) {
    for (const SegmentPoint& point : cloud.map_points) {
      const bool is_first = point.lidar == 0;
      from_first += is_first ? 1 : 0;
      std::size_t& other = cloud.begin_ns < 1000 * kMs   ? before
                           : cloud.begin_ns < 4000 * kMs ? meanwhile
                                                         : after;
      other += is_first ? 0 : 1;
    }
  }
  EXPECT_GT(from_first, 0U);
  EXPECT_GT(before, 0U);
  EXPECT_EQ(meanwhile, 0U);
  EXPECT_GT(after, 0U);
}

TEST(Segmenter, BridgesAShortPauseWithEmptySegmentsAndAJumpOfDaysWithOneGap) {
  Segmenter segmenter(SmallOptions());
  segmenter.AddScan(MakeScan(0, 200));
  segmenter.AddScan(MakeScan(500, 100));
  const std::int64_t days_ms = 3LL * 24 * 3600 * 1000;
  segmenter.AddScan(MakeScan(days_ms, 200));
  segmenter.Finish();
  const auto clouds = Drain(&segmenter);
  ASSERT_LT(clouds.size(), 40u);
  int gaps = 0, empty = 0;
  for (std::size_t k = 0; k < clouds.size(); ++k) {
    gaps += clouds[k].is_gap;
    empty += !clouds[k].is_gap && clouds[k].map_points.empty();
    if (k > 0) {
      EXPECT_EQ(clouds[k].begin_ns, clouds[k - 1].end_ns);
    }
  }
  EXPECT_EQ(gaps, 1);
  EXPECT_GE(empty, 8);
}

TEST(Segmenter, DropsARepeatedScanAndTimeThatGoesBackwards) {
  Segmenter segmenter(SmallOptions());
  segmenter.AddScan(MakeScan(0, 300));
  Drain(&segmenter);
  segmenter.AddScan(MakeScan(0, 100));
  EXPECT_EQ(segmenter.counts().too_late, 100);
  EXPECT_TRUE(Drain(&segmenter).empty());
}

/// Whatever comes: segments without holes, none shorter than a millisecond but for the instant with
/// which motion-corrected scans begin, and every point accounted for.
TEST(Segmenter, NoSegmentIsShorterThanAMillisecond) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    std::mt19937 random(seed);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    SegmenterOptions options = SmallOptions();
    options.map_voxel_m = 1e-4;
    options.max_range_m = 1e6;
    options.interval_s = std::vector<double>{0.03, 1e-9, 0.0, 0.1}[below(4)];
    options.max_gap_s = std::vector<double>{1.0, 0.0, 0.2}[below(3)];
    const int lidars = 1 + below(3);
    options.T_body_lidar.resize(static_cast<std::size_t>(lidars));
    const int discrete = below(3);  // Never, always, now and then.
    Segmenter segmenter(options);
    std::vector<std::int64_t> now_ns(3, 0);
    std::vector<SegmentCloud> clouds;
    for (int i = 0; i < 60; ++i) {
      const auto lidar = static_cast<std::size_t>(below(lidars));
      const std::int64_t steps_ns[] = {1,         999'999,    1'000'000, 7 * kMs,
                                       100 * kMs, 1000 * kMs, 2500 * kMs};
      now_ns[lidar] += steps_ns[below(7)];
      LidarScan scan = MakeScan(0, 20, static_cast<int>(lidar));
      scan.has_point_times = discrete == 0 || (discrete == 2 && below(2) == 0);
      scan.stamp_ns = now_ns[lidar];
      for (LidarPoint& point : scan.points) {
        point.t_ns = scan.has_point_times ? scan.stamp_ns + point.t_ns / 10 : scan.stamp_ns;
      }
      segmenter.AddScan(scan);
      while (auto cloud = segmenter.Next()) clouds.push_back(std::move(*cloud));
    }
    segmenter.Finish();
    while (auto cloud = segmenter.Next()) clouds.push_back(std::move(*cloud));
    ASSERT_FALSE(clouds.empty());
    for (std::size_t k = 0; k < clouds.size(); ++k) {
      const std::int64_t duration_ns = clouds[k].end_ns - clouds[k].begin_ns;
      const bool is_instant = k == 0 && discrete != 0 && duration_ns == 0;
      EXPECT_TRUE(duration_ns >= kMs || is_instant) << duration_ns << " seed " << seed;
      EXPECT_EQ(clouds[k].begin_ns, k > 0 ? clouds[k - 1].end_ns : clouds[k].begin_ns);
      for (const SegmentPoint& point : clouds[k].map_points) {
        EXPECT_TRUE(point.alpha >= 0.0F && point.alpha <= 1.0F) << "seed " << seed;
      }
    }
    EXPECT_EQ(segmenter.counts().received, 1200);
  }
}

TEST(Segmenter, TurnsRaysUpByTheVerticalCorrection) {
  SegmenterOptions options = SmallOptions();
  options.vertical_correction_deg = 0.205;
  Segmenter segmenter(options);
  LidarScan scan = MakeScan(0, 1);
  scan.points[0].xyz_m = {30.0F, 40.0F, 0.0F};
  segmenter.AddScan(scan);
  segmenter.Finish();
  const Eigen::Vector3f p = Drain(&segmenter)[0].map_points[0].p_body_m;
  EXPECT_NEAR(p.norm(), 50.0, 1e-4);
  EXPECT_NEAR(std::asin(p.z() / 50.0) * 180.0 / M_PI, 0.205, 1e-4);
  EXPECT_NEAR(p.y() / p.x(), 4.0 / 3.0, 1e-5);
}

TEST(Segmenter, RegistersAtMostSoManyPointsSpreadOverTheSegment) {
  SegmenterOptions options = SmallOptions();
  options.interval_s = 0.1;
  options.map_voxel_m = options.registration_voxel_m = 0.01;
  options.max_registration_points = 7;
  Segmenter segmenter(options);
  segmenter.AddScan(MakeScan(0, 100));
  segmenter.Finish();
  const auto clouds = Drain(&segmenter);
  ASSERT_EQ(clouds.size(), 1u);
  ASSERT_EQ(clouds[0].registration_points.size(), 7u);
  EXPECT_GT(clouds[0].map_points.size(), 90u);
  for (std::size_t i = 1; i < 7; ++i) {
    EXPECT_NEAR(clouds[0].registration_points[i].alpha - clouds[0].registration_points[i - 1].alpha,
                1.0 / 7, 0.02);
  }
}
}  // namespace
}  // namespace trajlo
