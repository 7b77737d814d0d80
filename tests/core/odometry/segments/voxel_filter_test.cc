// SPDX-License-Identifier: MIT
#include "core/odometry/segments/voxel_filter.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <set>

namespace trajlo {
namespace {

TEST(VoxelFilter, KeepsTheFirstPointOfEachCellWithItsTime) {
  std::mt19937 engine(1);
  std::uniform_real_distribution<float> coordinate(-20, 20);
  std::vector<SegmentPoint> points, kept;
  for (int i = 0; i < 20000; ++i) {
    SegmentPoint point = {{}, static_cast<float>(i) / 20000.0F};
    for (float& c : point.p_body_m) c = coordinate(engine);
    points.push_back(point);
  }
  VoxelFilter filter(1.7);
  for (int repeat = 0; repeat < 3; ++repeat) {
    filter.Filter(points, &kept);
    std::set<std::array<int, 3>> cells;
    std::vector<float> expected;
    for (const SegmentPoint& p : points) {
      std::array<int, 3> cell;
      for (int a = 0; a < 3; ++a) {
        cell[a] = static_cast<int>(std::floor(p.p_body_m[a] * static_cast<float>(1.0 / 1.7)));
      }
      if (cells.insert(cell).second) expected.push_back(p.alpha);
    }
    ASSERT_EQ(kept.size(), expected.size());
    for (std::size_t i = 0; i < kept.size(); ++i) EXPECT_EQ(kept[i].alpha, expected[i]);
  }
}
}  // namespace
}  // namespace trajlo
