// SPDX-License-Identifier: MIT
#include "core/export/scan_placer.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/random_poses.h"

namespace trajlo::testing {
namespace {

constexpr std::int64_t kBeginNs = 1'700'000'000'000'000'000;
constexpr std::int64_t kStepNs = 30'000'000;

Trajectory MakeTrajectory(Random* random, int poses) {
  Trajectory trajectory;
  SE3 T = random->Pose();
  for (int i = 0; i < poses; ++i) {
    trajectory.Append({kBeginNs + i * kStepNs, T, 0});
    T = Plus(T, random->Tangent(random->Uniform(0.0, 0.3), 0.5));
  }
  return trajectory;
}

/// Points at random times within `from` and `to`, in no order.
LidarScan MakeScan(Random* random, std::int64_t from_ns, std::int64_t to_ns, int points) {
  LidarScan scan;
  scan.stamp_ns = from_ns;
  for (int i = 0; i < points; ++i) {
    const double share = random->Uniform(0.0, 1.0);
    const auto offset_ns = static_cast<std::int64_t>(share * static_cast<double>(to_ns - from_ns));
    scan.points.push_back(
        {random->Vector(1.0, 50.0).cast<float>(), static_cast<float>(i), from_ns + offset_ns});
  }
  return scan;
}

TEST(ScanPlacer, PutsEveryPointWhereTheTrajectoryWasAtItsTime) {
  Random random(1);
  const Trajectory trajectory = MakeTrajectory(&random, 20);
  SegmenterOptions segmenter;
  segmenter.T_body_lidar = {random.Pose(), random.Pose()};
  ScanPlacer placer(&trajectory, segmenter);
  for (int lidar = 0; lidar < 3; ++lidar) {
    LidarScan scan = MakeScan(&random, kBeginNs, kBeginNs + 19 * kStepNs, 500);
    scan.lidar_id = lidar;  // The third has no extrinsics: the identity.
    scan.points[0].t_ns = kBeginNs;
    scan.points[1].t_ns = kBeginNs + 19 * kStepNs;
    scan.points[2].t_ns = kBeginNs + 7 * kStepNs;
    const auto placed = placer.Place(scan);
    ASSERT_TRUE(placed);
    EXPECT_EQ(placed->t_ns, kBeginNs + 19 * kStepNs);
    ASSERT_EQ(placed->points_world_m.size(), scan.points.size());
    const SE3 T_body_lidar =
        lidar < 2 ? segmenter.T_body_lidar[static_cast<std::size_t>(lidar)] : SE3();
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      const LidarPoint& point = scan.points[i];
      const Eigen::Vector3d expected =
          *trajectory.At(point.t_ns) * (T_body_lidar * point.xyz_m.cast<double>());
      EXPECT_NEAR((placed->points_world_m[i] - expected).norm(), 0.0, 1e-9) << i;
      EXPECT_EQ(placed->intensities[i], point.intensity);
    }
  }
  EXPECT_EQ(placer.counts().placed, 1500u);
  EXPECT_EQ(placer.counts().Received(), 1500u);
}

TEST(ScanPlacer, CountsWhatCannotBePlaced) {
  Random random(2);
  const Trajectory trajectory = MakeTrajectory(&random, 5);
  SegmenterOptions segmenter;
  segmenter.min_range_m = 2.0;
  segmenter.max_range_m = 40.0;
  ScanPlacer placer(&trajectory, segmenter);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  LidarScan scan;
  scan.points = {{{1.0F, 0.0F, 0.0F}, 0.0F, kBeginNs},
                 {{50.0F, 0.0F, 0.0F}, 0.0F, kBeginNs},
                 {{nan, 3.0F, 0.0F}, 0.0F, kBeginNs},
                 {{3.0F, 0.0F, 0.0F}, 0.0F, kBeginNs - 1},
                 {{3.0F, 0.0F, 0.0F}, 0.0F, kBeginNs + 4 * kStepNs + 1}};
  EXPECT_FALSE(placer.Place(scan));
  EXPECT_EQ(placer.counts().unusable, 3u);
  EXPECT_EQ(placer.counts().outside, 2u);
  scan.points.push_back({{3.0F, 0.0F, 0.0F}, 0.0F, kBeginNs + 1});
  const auto placed = placer.Place(scan);
  ASSERT_TRUE(placed);
  EXPECT_EQ(placed->points_world_m.size(), 1u);
  EXPECT_EQ(placed->t_ns, kBeginNs + 1);
}

TEST(ScanPlacer, WithinAPauseNothingIsPlacedAndAtItsEndsEverything) {
  Trajectory trajectory;
  trajectory.Append({kBeginNs, SE3(), 0});
  trajectory.Append({kBeginNs + 3'000'000'000, SE3(), 0});
  SegmenterOptions segmenter;
  segmenter.max_gap_s = 1.0;
  ScanPlacer placer(&trajectory, segmenter);
  LidarScan scan;
  for (const std::int64_t offset_ns :
       {0LL, 1LL, 1'500'000'000LL, 2'999'999'999LL, 3'000'000'000LL}) {
    scan.points.push_back({{3.0F, 0.0F, 0.0F}, 0.0F, kBeginNs + offset_ns});
  }
  ASSERT_TRUE(placer.Place(scan));
  EXPECT_EQ(placer.counts().in_pause, 3u);
  EXPECT_EQ(placer.counts().placed, 2u);
}

TEST(ScanPlacer, ASinglePoseHoldsForItsInstant) {
  Trajectory trajectory;
  trajectory.Append({kBeginNs, SE3(), 0});
  ScanPlacer placer(&trajectory, {});
  LidarScan scan;
  scan.points = {{{3.0F, 0.0F, 0.0F}, 0.0F, kBeginNs}, {{3.0F, 0.0F, 0.0F}, 0.0F, kBeginNs + 1}};
  ASSERT_TRUE(placer.Place(scan));
  EXPECT_EQ(placer.counts().placed, 1u);
  EXPECT_EQ(placer.counts().outside, 1u);
}

}  // namespace
}  // namespace trajlo::testing
