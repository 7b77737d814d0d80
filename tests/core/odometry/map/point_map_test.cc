// SPDX-License-Identifier: MIT
#include "core/odometry/map/point_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/odometry/map/kd_tree_map.h"
#include "core/odometry/map/voxel_hash_map.h"
#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

std::vector<Eigen::Vector3d> RandomPoints(int count, double half_size,
                                          const Eigen::Vector3d& center, unsigned seed) {
  testing::Random random(seed);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(center + Eigen::Vector3d(random.Uniform(-half_size, half_size),
                                              random.Uniform(-half_size, half_size),
                                              random.Uniform(-half_size, half_size)));
  }
  return points;
}

MapOptions Options(double voxel_m, double spacing_m) {
  MapOptions options;
  options.voxel_size_m = voxel_m;
  options.min_point_spacing_m = spacing_m;
  return options;
}

/// The k smallest distances among the stored points of the seven voxels around the query.
std::vector<double> SevenVoxelDistances(const PointMap& map, const Eigen::Vector3d& query,
                                        double voxel, int k) {
  std::vector<double> distances;
  const Eigen::Vector3d own = (query / voxel).array().floor();
  map.ForEachPoint([&](const Eigen::Vector3d& p) {
    const Eigen::Vector3d cell = (p / voxel).array().floor();
    if ((cell - own).cwiseAbs().sum() <= 1.0) distances.push_back((p - query).norm());
  });
  std::sort(distances.begin(), distances.end());
  if (distances.size() > static_cast<std::size_t>(k)) distances.resize(k);
  return distances;
}

TEST(VoxelHashMap, FindsTheNearestPointsOfItsSevenVoxels) {
  // Negative coordinates, too: indices must be floored, not truncated.
  VoxelHashMap map(Options(0.7, 0.05));
  map.Insert(RandomPoints(30000, 5.0, Eigen::Vector3d::Zero(), 1));
  for (const auto& query : RandomPoints(500, 5.2, Eigen::Vector3d::Zero(), 2)) {
    for (int k : {1, 5, 8, 20}) {
      Neighbors found;
      map.Nearest(query, k, 1, &found);
      const auto expected = SevenVoxelDistances(map, query, 0.7, k);
      ASSERT_EQ(found.count, static_cast<int>(expected.size()));
      for (int i = 0; i < found.count; ++i) {
        EXPECT_NEAR(std::sqrt(found.squared_distance[i]), expected[i], 1e-5);
        const Eigen::Vector3d p =
            found.origin_world + Eigen::Vector3d(found.x[i], found.y[i], found.z[i]);
        EXPECT_NEAR((p - query).norm(), expected[i], 1e-5);
      }
    }
  }
}

TEST(VoxelHashMap, GivesNothingOrTheSameWhereSomeNeighboursAreWanted) {
  // Sparse enough that many queries have fewer than wanted; large enough that the counts have
  // grown, and with a part of the map removed.
  MapOptions options = Options(0.5, 0.0);
  options.radius_m = 12.0;
  VoxelHashMap map(options);
  map.Insert(RandomPoints(20000, 10.0, Eigen::Vector3d::Zero(), 11));
  map.RemoveFar({5, 0, 0});
  int given = 0, withheld = 0;
  for (const auto& query : RandomPoints(2000, 10.0, Eigen::Vector3d::Zero(), 12)) {
    Neighbors all, wanted;
    map.Nearest(query, 8, 1, &all);
    map.Nearest(query, 8, 4, &wanted);
    if (all.count < 4) {
      EXPECT_TRUE(wanted.count == 0 || wanted.count == all.count);
      withheld += wanted.count < all.count;
      continue;
    }
    ++given;
    ASSERT_EQ(wanted.count, all.count);
    for (int i = 0; i < all.count; ++i) {
      EXPECT_EQ(wanted.squared_distance[i], all.squared_distance[i]);
    }
  }
  EXPECT_GT(given, 50);
  EXPECT_GT(withheld, 50);
}

TEST(VoxelHashMap, AgreesWithTheKdTreeWhereTheNeighboursAreInReach) {
  const MapOptions options = Options(1.0, 0.02);
  VoxelHashMap hash(options);
  KdTreeMap tree(options);
  const auto points = RandomPoints(20000, 4.0, Eigen::Vector3d::Zero(), 3);
  for (int batch = 0; batch < 10; ++batch) {
    const std::vector<Eigen::Vector3d> part(points.begin() + batch * 2000,
                                            points.begin() + (batch + 1) * 2000);
    hash.Insert(part);
    tree.Insert(part);
  }
  ASSERT_EQ(hash.size(), tree.size());
  int compared = 0;
  for (const auto& query : RandomPoints(2000, 3.9, Eigen::Vector3d::Zero(), 4)) {
    Neighbors a, b;
    hash.Nearest(query, 5, 1, &a);
    tree.Nearest(query, 5, 1, &b);
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

TEST(KdTreeMap, FindsTheNearestPointsOfTheWholeMapAlsoAfterRemoval) {
  MapOptions options = Options(1.0, 0.0);
  options.radius_m = 6.0;
  KdTreeMap map(options);
  map.Insert(RandomPoints(4000, 8.0, Eigen::Vector3d::Zero(), 5));
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<Eigen::Vector3d> stored;
    map.ForEachPoint([&](const Eigen::Vector3d& p) { stored.push_back(p); });
    for (const auto& query : RandomPoints(100, 8.0, Eigen::Vector3d::Zero(), 6)) {
      std::sort(stored.begin(), stored.end(), [&](const auto& a, const auto& b) {
        return (a - query).squaredNorm() < (b - query).squaredNorm();
      });
      Neighbors found;
      map.Nearest(query, 5, 1, &found);
      ASSERT_EQ(found.count, 5);
      for (int i = 0; i < 5; ++i) {
        EXPECT_NEAR(std::sqrt(found.squared_distance[i]), (stored[i] - query).norm(), 1e-5);
      }
    }
    map.RemoveFar(Eigen::Vector3d::Zero());
  }
}

class EveryMap : public ::testing::TestWithParam<MapKind> {};

TEST_P(EveryMap, IsEmptyAtFirstAndBoundedByVoxelsTimesCap) {
  MapOptions options = Options(1.0, 0.0);
  options.kind = GetParam();
  const auto map = MakePointMap(options);
  Neighbors found;
  map->Nearest({0, 0, 0}, 5, 1, &found);
  EXPECT_EQ(found.count, 0);
  map->Insert(RandomPoints(50000, 1.0, Eigen::Vector3d::Zero(), 7));
  EXPECT_EQ(map->size(), 8u * 20u);
}

TEST_P(EveryMap, DropsWhatIsFarAndKeepsWhatIsNear) {
  MapOptions options = Options(0.5, 0.0);
  options.kind = GetParam();
  options.radius_m = 10.0;
  const auto map = MakePointMap(options);
  map->Insert(RandomPoints(2000, 2.0, {0, 0, 0}, 8));
  const std::size_t near = map->size();
  map->Insert(RandomPoints(2000, 2.0, {30, 0, 0}, 9));
  map->RemoveFar({0, 0, 0});
  EXPECT_EQ(map->size(), near);
  map->RemoveFar({30, 0, 0});
  EXPECT_EQ(map->size(), 0u);
  map->Insert(RandomPoints(2000, 2.0, {30, 0, 0}, 9));
  Neighbors found;
  map->Nearest({30, 0, 0}, 5, 1, &found);
  EXPECT_EQ(found.count, 5);
}

TEST_P(EveryMap, IsPreciseAMillionMetresFromTheOrigin) {
  MapOptions options = Options(0.2, 0.0);
  options.kind = GetParam();
  const Eigen::Vector3d far(1e6, -1e6, 1e6);
  const auto map = MakePointMap(options);
  map->Insert({far + Eigen::Vector3d(0.01, 0.02, 0.03), far + Eigen::Vector3d(0.05, 0.02, 0.03)});
  Neighbors found;
  map->Nearest(far + Eigen::Vector3d(0.02, 0.02, 0.03), 5, 1, &found);
  ASSERT_EQ(found.count, 2);
  EXPECT_NEAR(std::sqrt(found.squared_distance[0]), 0.01, 1e-6);
  EXPECT_NEAR(std::sqrt(found.squared_distance[1]), 0.03, 1e-6);
}

TEST_P(EveryMap, KeepsPointsOfAVoxelApart) {
  MapOptions options = Options(1.0, 0.25);
  options.kind = GetParam();
  const auto map = MakePointMap(options);
  map->Insert(RandomPoints(5000, 2.0, {0, 0, 0}, 10));
  std::vector<Eigen::Vector3d> stored;
  map->ForEachPoint([&](const Eigen::Vector3d& p) { stored.push_back(p); });
  for (std::size_t i = 0; i < stored.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Eigen::Vector3d a = stored[i].array().floor(), b = stored[j].array().floor();
      if (a == b) {
        EXPECT_GE((stored[i] - stored[j]).norm(), 0.25 - 1e-5);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryMap, ::testing::Values(MapKind::kVoxelHash, MapKind::kKdTree));

}  // namespace
}  // namespace trajlo
