// SPDX-License-Identifier: MIT
#include "core/odometry/map/voxel_hash_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "tests/support/map_points.h"

namespace trajlo {
namespace {

using testing::MapPoints;
using testing::PlacesOf;
using testing::RandomPoints;

VoxelHashMap MakeMap(double voxel_m, double spacing_m, double radius_m = 100.0) {
  return VoxelHashMap(voxel_m, spacing_m, radius_m);
}

std::vector<Eigen::Vector3d> Stored(const VoxelHashMap& map) {
  std::vector<Eigen::Vector3d> points;
  map.ForEachPoint([&](const MapPoint& point) { points.push_back(point.place_world); });
  return points;
}

/// How many bricks the index has between two bricks, which are at the corners of a box.
std::size_t BricksBetween(const VoxelIndex& index, const VoxelKey& low, const VoxelKey& high) {
  std::size_t bricks = 0;
  for (int x = low.x(); x <= high.x(); ++x) {
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int z = low.z(); z <= high.z(); ++z) {
        bricks += index.Find({4 * x, 4 * y, 4 * z}) != VoxelIndex::kNoSlot ? 1 : 0;
      }
    }
  }
  return bricks;
}

/// The k smallest distances among the stored points of the seven voxels around the query.
std::vector<double> SevenVoxelDistances(const VoxelHashMap& map, const Eigen::Vector3d& query,
                                        double voxel, int k) {
  std::vector<double> distances;
  const Eigen::Vector3d own = (query / voxel).array().floor();
  map.ForEachPoint([&](const MapPoint& point) {
    const Eigen::Vector3d& p = point.place_world;
    const Eigen::Vector3d cell = (p / voxel).array().floor();
    if ((cell - own).cwiseAbs().sum() <= 1.0) distances.push_back((p - query).norm());
  });
  std::sort(distances.begin(), distances.end());
  if (distances.size() > static_cast<std::size_t>(k)) distances.resize(k);
  return distances;
}

TEST(VoxelHashMap, FindsTheNearestPointsOfItsSevenVoxels) {
  // Negative coordinates, too: indices must be floored, not truncated.
  VoxelHashMap map = MakeMap(0.7, 0.05);
  map.Insert(MapPoints(RandomPoints(30000, 5.0, Eigen::Vector3d::Zero(), 1)));
  for (const auto& query : RandomPoints(500, 5.2, Eigen::Vector3d::Zero(), 2)) {
    for (int k : {1, 5, 8, 20}) {
      Neighbors found;
      map.Nearest(query, k, &found);
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

TEST(VoxelHashMap, KnowsHowManyPointsThereAreAroundEveryVoxel) {
  // Small voxels, and a part of the map removed twice: numbers of sites are given anew.
  VoxelHashMap map = MakeMap(0.5, 0.0, 12.0);
  std::vector<std::uint32_t> changed;
  for (int pass = 0; pass < 3; ++pass) {
    const Eigen::Vector3d center(8.0 * pass, 0, 0);
    map.Insert(MapPoints(RandomPoints(20000, 10.0, center, 11 + static_cast<unsigned>(pass))));
    map.RemoveFar(center, &changed);
  }
  EXPECT_GT(changed.size(), 1000u);
  std::map<std::array<int, 3>, unsigned> around;
  for (const Eigen::Vector3d& p : Stored(map)) {
    const VoxelKey key = VoxelAt(p, 1.0 / 0.5);
    for (int axis = 0; axis < 3; ++axis) {
      for (int step : {-1, 1}) {
        VoxelKey near = key;
        near[axis] += step;
        ++around[{near.x(), near.y(), near.z()}];
      }
    }
    ++around[{key.x(), key.y(), key.z()}];
  }
  std::set<std::array<int, 3>> bricks;
  for (const auto& [key, points] : around) bricks.insert({key[0] >> 2, key[1] >> 2, key[2] >> 2});
  EXPECT_EQ(BricksBetween(map.index(), {-20, -20, -20}, {20, 20, 20}), bricks.size());
  std::set<std::uint32_t> sites;
  for (const auto& [key, points] : around) {
    const VoxelIndex::Slot slot = map.index().Find({key[0], key[1], key[2]});
    ASSERT_NE(slot, VoxelIndex::kNoSlot);
    const VoxelIndex::Entry& entry = map.index()[slot];
    EXPECT_EQ(entry.points_around, points);
    EXPECT_EQ(entry.site != VoxelIndex::kNoSite, points >= 5);
    if (points < 5) continue;
    EXPECT_LT(entry.site, map.site_capacity());
    EXPECT_TRUE(sites.insert(entry.site).second);
  }
  EXPECT_GT(sites.size(), 1000u);
}

TEST(VoxelHashMap, IsBoundedByVoxelsTimesTwentyPoints) {
  VoxelHashMap map = MakeMap(1.0, 0.0);
  Neighbors found;
  map.Nearest({0, 0, 0}, 5, &found);
  EXPECT_EQ(found.count, 0);
  map.Insert(MapPoints(RandomPoints(50000, 1.0, Eigen::Vector3d::Zero(), 7)));
  EXPECT_EQ(map.size(), 8u * 20u);
  EXPECT_EQ(Stored(map).size(), map.size());
}

TEST(VoxelHashMap, WhatItRefusesMayBeDroppedBefore) {
  VoxelHashMap map = MakeMap(0.5, 0.12);
  VoxelHashMap with_dropping = MakeMap(0.5, 0.12);
  for (unsigned seed = 0; seed < 10; ++seed) {
    const auto points = RandomPoints(3000, 2.0, Eigen::Vector3d(0.3 * seed, 0.0, 0.0), seed);
    std::vector<MapPoint> wanted = MapPoints(points);
    with_dropping.DropRefused(&wanted);
    EXPECT_EQ(PlacesOf(map.Insert(MapPoints(points))), PlacesOf(with_dropping.Insert(wanted)));
    EXPECT_EQ(Stored(map), Stored(with_dropping));
    if (seed > 0) {
      EXPECT_LT(wanted.size(), points.size());
    }
  }
}

TEST(VoxelHashMap, DropsWhatIsFarAndKeepsWhatIsNear) {
  VoxelHashMap map = MakeMap(0.5, 0.0, 10.0);
  std::vector<std::uint32_t> changed;
  map.Insert(MapPoints(RandomPoints(2000, 2.0, {0, 0, 0}, 8)));
  const std::vector<Eigen::Vector3d> near = Stored(map);
  map.Insert(MapPoints(RandomPoints(2000, 2.0, {30, 0, 0}, 9)));
  map.RemoveFar({0, 0, 0}, &changed);
  EXPECT_EQ(Stored(map), near);
  map.RemoveFar({30, 0, 0}, &changed);
  EXPECT_EQ(map.size(), 0u);
  EXPECT_EQ(BricksBetween(map.index(), {-5, -5, -5}, {20, 5, 5}), 0u);
  map.Insert(MapPoints(RandomPoints(2000, 2.0, {30, 0, 0}, 9)));
  Neighbors found;
  map.Nearest({30, 0, 0}, 5, &found);
  EXPECT_EQ(found.count, 5);
}

TEST(VoxelHashMap, StaysAsSmallAsItsSurroundingsOnALongWay) {
  VoxelHashMap map = MakeMap(0.5, 0.1, 10.0);
  const auto count_bricks = [&] {
    return BricksBetween(map.index(), {-5, -5, -5}, {65, 5, 5});  // All that is ever passed.
  };
  std::vector<std::uint32_t> changed;
  std::size_t sites = 0, bricks = 0;
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector3d center(2.0 * i, 0, 0);
    map.Insert(MapPoints(RandomPoints(4000, 5.0, center, static_cast<unsigned>(i))));
    map.RemoveFar(center, &changed);
    if (i == 15) {
      sites = map.site_capacity();
      bricks = count_bricks();
    }
  }
  EXPECT_GT(sites, 1000u);
  EXPECT_LT(static_cast<double>(map.site_capacity()), 1.1 * static_cast<double>(sites));
  EXPECT_LT(static_cast<double>(count_bricks()), 1.1 * static_cast<double>(bricks));
}

TEST(VoxelHashMap, IsPreciseAMillionMetresFromTheOrigin) {
  // Voxels whose corners are no numbers of single precision there, and neighbours in all seven.
  const Eigen::Vector3d far(1e6, -1e6, 1e6);
  constexpr double kVoxel = 0.3;
  VoxelHashMap map = MakeMap(kVoxel, 0.0);
  const auto added = PlacesOf(map.Insert(MapPoints(RandomPoints(3000, 1.0, far, 21))));
  const std::vector<Eigen::Vector3d> stored = Stored(map);
  for (const Eigen::Vector3d& p : stored) {
    double nearest = 1.0;
    for (const Eigen::Vector3d& q : added) nearest = std::min(nearest, (p - q).norm());
    EXPECT_LT(nearest, 1e-6);
  }
  for (const auto& query : RandomPoints(200, 0.9, far, 22)) {
    Neighbors found;
    map.Nearest(query, 20, &found);
    const auto expected = SevenVoxelDistances(map, query, kVoxel, 20);
    ASSERT_EQ(found.count, static_cast<int>(expected.size()));
    for (int i = 0; i < found.count; ++i) {
      EXPECT_NEAR(std::sqrt(found.squared_distance[i]), expected[i], 1e-6);
    }
  }
}

TEST(VoxelHashMap, OfEquallyNearPointsTheOwnVoxelsComeFirstInTheOrderOfInsertion) {
  // Distances that are exact in single precision.
  VoxelHashMap map = MakeMap(1.0, 0.0);
  const Eigen::Vector3d query(0.5, 0.5, 0.5);
  const std::vector<Eigen::Vector3d> offsets = {{1, 0, 0},     {-0.25, 0, 0}, {0, 0.25, 0},
                                                {0, -1, 0},    {0, 0, -0.25}, {0.25, 0, 0},
                                                {0, -0.25, 0}, {0, 0, 0.25}};
  for (const Eigen::Vector3d& offset : offsets) map.Insert({{query + offset}});
  const auto nearest = [&](int k) {
    Neighbors found;
    map.Nearest(query, k, &found);
    std::vector<Eigen::Vector3d> result;
    for (int i = 0; i < found.count; ++i) {
      result.emplace_back(found.origin_world + Eigen::Vector3d(found.x[i], found.y[i], found.z[i]) -
                          query);
    }
    return result;
  };
  EXPECT_EQ(nearest(3), (std::vector<Eigen::Vector3d>{offsets[1], offsets[2], offsets[4]}));
  const auto all = nearest(8);
  ASSERT_EQ(all.size(), 8u);
  EXPECT_EQ(all[4], offsets[6]);
  EXPECT_EQ(all[5], offsets[7]);
  // Then those of the neighbours, in the order of the faces.
  EXPECT_EQ(all[6], offsets[0]);
  EXPECT_EQ(all[7], offsets[3]);

  // Between two voxels.
  map.Insert(MapPoints({{5.0, 0.5, 0.5}, {4.75, 0.5, 0.5}}));
  Neighbors found;
  map.Nearest({4.875, 0.5, 0.5}, 1, &found);
  ASSERT_EQ(found.count, 1);
  EXPECT_EQ(found.origin_world.x() + found.x[0], 4.75);
}

TEST(VoxelHashMap, KnowsFromWhereItsPointsWereSeen) {
  VoxelHashMap map = MakeMap(0.5, 0.05);
  const Eigen::Vector3d sensor(0.3, -0.4, 5.0);
  map.Insert(MapPoints(RandomPoints(5000, 2.0, {0, 0, 0}, 12), sensor));
  const auto expect_seen = [&](const Eigen::Vector3d& place, const Eigen::Vector3f& direction) {
    const Eigen::Vector3f expected = (sensor - place).normalized().cast<float>();
    EXPECT_LT((direction - expected).cwiseAbs().maxCoeff(), SeenFrom::kPrecision);
  };
  map.ForEachPoint(
      [&](const MapPoint& point) { expect_seen(point.place_world, point.to_sensor_world); });
  for (const auto& query : RandomPoints(100, 2.0, {0, 0, 0}, 13)) {
    Neighbors found;
    map.Nearest(query, 8, &found);
    ASSERT_GT(found.count, 0);
    for (int i = 0; i < found.count; ++i) {
      const Eigen::Vector3d place =
          found.origin_world + Eigen::Vector3d(found.x[i], found.y[i], found.z[i]);
      expect_seen(place, found.seen_from[i].Direction());
    }
  }
}

TEST(VoxelHashMap, SurvivesPointsThatRanAway) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  VoxelHashMap map = MakeMap(0.2, 0.1);
  map.Insert(MapPoints({{1e300, 0, 0}, {kNan, 0, 0}, {0, -1e300, kNan}, {0, 0, 0}}));
  Neighbors found;
  map.Nearest({0.01, 0, 0}, 5, &found);
  EXPECT_EQ(found.count, 1);
  map.Nearest({kNan, kNan, kNan}, 5, &found);
  map.Nearest({1e300, -1e300, 0}, 5, &found);
  std::vector<std::uint32_t> changed;
  map.RemoveFar({0, 0, 0}, &changed);
  EXPECT_EQ(Stored(map).size(), map.size());
}

TEST(VoxelHashMap, KeepsPointsOfAVoxelApart) {
  VoxelHashMap map = MakeMap(1.0, 0.25);
  map.Insert(MapPoints(RandomPoints(5000, 2.0, {0, 0, 0}, 10)));
  const std::vector<Eigen::Vector3d> stored = Stored(map);
  for (std::size_t i = 0; i < stored.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Eigen::Vector3d a = stored[i].array().floor(), b = stored[j].array().floor();
      if (a == b) {
        EXPECT_GE((stored[i] - stored[j]).norm(), 0.25 - 1e-5);
      }
    }
  }
}

}  // namespace
}  // namespace trajlo
