// SPDX-License-Identifier: MIT
#include "core/odometry/segments/segment_thinner.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace trajlo {
namespace {

constexpr double kMapVoxel_m = 0.1, kVoxel_m = 0.4;
constexpr std::int64_t kSegment_ns = 30'000'000;

/// Points 0.05 m apart on a square of `side_m`, a wall.
std::vector<SegmentPoint> Wall(float side_m) {
  std::vector<SegmentPoint> points;
  for (float y = 0.025F; y < side_m; y += 0.05F) {
    for (float z = 0.025F; z < side_m; z += 0.05F) {
      points.push_back({{2.0F, y, z}, 0.5F, 0});
    }
  }
  return points;
}

/// How many points of `n` segments in a row are registered in the last one.
std::size_t RegisteredAfter(int n, const std::vector<SegmentPoint>& points,
                            SegmentThinner* thinner) {
  SegmentCloud cloud;
  for (int i = 0; i < n; ++i) {
    cloud.begin_ns = i * kSegment_ns;
    cloud.end_ns = cloud.begin_ns + kSegment_ns;
    thinner->Thin(points, &cloud);
  }
  return cloud.registration_points.size();
}

TEST(SegmentThinner, TakesOnePointOfACell) {
  SegmentThinner thinner(kMapVoxel_m, kVoxel_m, 0);
  SegmentCloud cloud;
  cloud.end_ns = kSegment_ns;
  thinner.Thin(Wall(8.0F), &cloud);
  EXPECT_EQ(cloud.map_points.size(), 80U * 80U);
  EXPECT_EQ(cloud.registration_points.size(), 20U * 20U);
}

TEST(SegmentThinner, TakesHalfTheCellsWhereFewAreHit) {
  SegmentThinner thinner(kMapVoxel_m, kVoxel_m, 0);
  EXPECT_EQ(RegisteredAfter(1, Wall(2.0F), &thinner), 10U * 10U);
}

TEST(SegmentThinner, LooksNoCloserAtAHandBeforeTheLidar) {
  SegmentThinner thinner(kMapVoxel_m, kVoxel_m, 0);
  EXPECT_EQ(RegisteredAfter(1, Wall(8.0F), &thinner), 20U * 20U);
  const std::vector<SegmentPoint> hand = Wall(0.8F);
  EXPECT_EQ(RegisteredAfter(20, hand, &thinner), 2U * 2U);
  // It has come to stay.
  EXPECT_EQ(RegisteredAfter(80, hand, &thinner), 4U * 4U);
}

TEST(SegmentThinner, RegistersNoMoreThanItMay) {
  SegmentThinner thinner(kMapVoxel_m, kVoxel_m, 50);
  EXPECT_EQ(RegisteredAfter(1, Wall(8.0F), &thinner), 50U);
  SegmentThinner narrow(kMapVoxel_m, kVoxel_m, 50);
  EXPECT_EQ(RegisteredAfter(1, Wall(2.0F), &narrow), 50U);
}

}  // namespace
}  // namespace trajlo
