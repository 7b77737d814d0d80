// SPDX-License-Identifier: MIT
#include "core/odometry/map/kd_tree_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/odometry/map/voxel_hash_map.h"
#include "tests/support/map_points.h"

namespace trajlo {
namespace {

using testing::MapPoints;
using testing::RandomPoints;

TEST(KdTreeIndex, AgreesWithTheVoxelsWhereTheNeighboursAreInReach) {
  VoxelHashMap hash(1.0, 0.02, 100.0);
  KdTreeIndex tree;
  const auto points = RandomPoints(20000, 4.0, Eigen::Vector3d::Zero(), 3);
  for (int batch = 0; batch < 10; ++batch) {
    tree.Add(hash.Insert(
        MapPoints({points.begin() + batch * 2000, points.begin() + (batch + 1) * 2000})));
  }
  int compared = 0;
  for (const auto& query : RandomPoints(2000, 3.9, Eigen::Vector3d::Zero(), 4)) {
    Neighbors a, b;
    hash.Nearest(query, 5, &a);
    tree.Nearest(query, 5, &b);
    ASSERT_EQ(b.count, 5);
    // The hash is exact up to the distance of the nearest voxel that it does not search: the edges.
    const Eigen::Vector3d in_cell = query.array() - query.array().floor();
    const Eigen::Vector3d to_face = in_cell.cwiseMin(Eigen::Vector3d::Ones() - in_cell);
    Eigen::Vector3d sorted = to_face;
    std::sort(sorted.data(), sorted.data() + 3);
    const double reach = std::hypot(sorted[0], sorted[1]);
    if (a.count < 5 || std::sqrt(b.squared_distance[4]) >= reach) continue;
    ++compared;
    for (int i = 0; i < 5; ++i) EXPECT_NEAR(a.squared_distance[i], b.squared_distance[i], 1e-5);
  }
  EXPECT_GT(compared, 100);
}

TEST(KdTreeIndex, FindsTheNearestPoints) {
  KdTreeIndex tree;
  Neighbors found;
  tree.Nearest({0, 0, 0}, 5, &found);
  EXPECT_EQ(found.count, 0);
  for (unsigned pass = 0; pass < 2; ++pass) {
    std::vector<Eigen::Vector3d> stored =
        RandomPoints(4000, 8.0, Eigen::Vector3d::Zero(), 5 + pass);
    tree.Clear();
    tree.Add(MapPoints(stored));
    for (const auto& query : RandomPoints(100, 8.0, Eigen::Vector3d::Zero(), 6)) {
      std::sort(stored.begin(), stored.end(), [&](const auto& a, const auto& b) {
        return (a - query).squaredNorm() < (b - query).squaredNorm();
      });
      tree.Nearest(query, 5, &found);
      ASSERT_EQ(found.count, 5);
      for (int i = 0; i < 5; ++i) {
        EXPECT_NEAR(std::sqrt(found.squared_distance[i]), (stored[i] - query).norm(), 1e-5);
      }
    }
  }
}

}  // namespace
}  // namespace trajlo
