// SPDX-License-Identifier: MIT
#include "core/odometry/map/map_level.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/map_points.h"
#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

/// Points of a rough floor in [-half, half]².
std::vector<Eigen::Vector3d> Floor(int count, double half, double roughness_m, unsigned seed) {
  testing::Random random(seed);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(random.PlaceIn({half, half, 0.0}));
    points.back().z() = random.Gaussian(roughness_m);
  }
  return points;
}

MapOptions Options(MapKind kind, bool shared_planes) {
  MapOptions options;
  options.kind = kind;
  options.shared_planes = shared_planes;
  return options;
}

FittedPlane Ask(const MapLevel& level, const Eigen::Vector3d& p, Eigen::Vector3d* center) {
  const VoxelKey cell = level.CellOf(p);
  *center = level.shares_planes() ? level.CenterOf(cell) : p;
  const VoxelIndex::Entry* site = level.FindSite(level.Locate(cell), cell);
  return site == nullptr ? FittedPlane() : level.PlaneAt(*site, cell, *center);
}

bool AreSame(const FittedPlane& a, const FittedPlane& b) {
  return a.normal_world == b.normal_world && a.offset_m == b.offset_m &&
         a.thickness_m == b.thickness_m && a.width_m == b.width_m;
}

class BothKinds : public ::testing::TestWithParam<MapKind> {};

TEST_P(BothKinds, SharedPlanesAreThoseOfTheCellsCentres) {
  MapLevel shared(Options(GetParam(), true), {}), own(Options(GetParam(), false), {});
  const auto floor = Floor(4000, 3.0, 0.01, 1);
  shared.Insert(testing::MapPoints(floor));
  own.Insert(testing::MapPoints(floor));
  int found = 0;
  for (int pass = 0; pass < 2; ++pass) {
    for (const Eigen::Vector3d& p : Floor(500, 3.2, 0.1, 2)) {
      Eigen::Vector3d center, same;
      const FittedPlane plane = Ask(shared, p, &center);
      if (!plane.exists()) continue;
      ++found;
      EXPECT_LE((center - p).cwiseAbs().maxCoeff(), 0.5 * 0.15 + 1e-12);
      EXPECT_TRUE(AreSame(plane, Ask(own, center, &same)));
      EXPECT_EQ(same, center);
    }
  }
  EXPECT_GT(found, 500);
}

INSTANTIATE_TEST_SUITE_P(Kinds, BothKinds,
                         ::testing::Values(MapKind::kVoxelHash, MapKind::kKdTree));

TEST(MapLevel, APlaneFollowsTheMapWhenItHasGrownByMoreThanAnEighth) {
  MapOptions options = Options(MapKind::kVoxelHash, true);
  options.min_point_spacing_m = 0.02;
  MapLevel level(options, {});
  const Eigen::Vector3d asked(0.05, 0.05, 0.05);
  Eigen::Vector3d center;
  std::uint32_t fitted_at = 0;
  FittedPlane kept;
  int changes = 0;
  for (const Eigen::Vector3d& p : Floor(60000, 4.0, 0.01, 3)) {
    level.Insert({{p}});
    const VoxelKey cell = level.CellOf(asked);
    const VoxelIndex::Entry* site = level.FindSite(level.Locate(cell), cell);
    if (site == nullptr) continue;
    const FittedPlane plane = Ask(level, asked, &center);
    if (fitted_at == 0 || site->points_around > fitted_at + fitted_at / 8 + 1) {
      Neighbors neighbors;
      level.points().Nearest(center, 8, &neighbors);
      EXPECT_TRUE(AreSame(plane, FitPlane(neighbors, center, {}, options.min_point_spacing_m)));
      fitted_at = site->points_around;
      kept = plane;
      ++changes;
    }
    EXPECT_TRUE(AreSame(plane, kept));
  }
  EXPECT_GT(changes, 10);
  EXPECT_GT(fitted_at, 60u);
}

TEST(MapLevel, APlaneIsGoneWithItsPoints) {
  MapOptions options = Options(MapKind::kVoxelHash, true);
  options.radius_m = 8.0;
  MapLevel level(options, {});
  level.Insert(testing::MapPoints(Floor(4000, 3.0, 0.01, 4)));
  Eigen::Vector3d center;
  int before = 0, after = 0;
  for (const Eigen::Vector3d& p : Floor(200, 3.0, 0.01, 5)) {
    before += Ask(level, p, &center).exists();
  }
  level.RemoveFar({20, 0, 0});
  for (const Eigen::Vector3d& p : Floor(200, 3.0, 0.01, 5)) {
    after += Ask(level, p, &center).exists();
  }
  EXPECT_GT(before, 150);
  EXPECT_EQ(after, 0);
  // Another floor, whose sites have the numbers of the former one, lies half a metre higher.
  auto higher = Floor(4000, 3.0, 0.01, 4);
  for (Eigen::Vector3d& p : higher) p += Eigen::Vector3d(20.0, 0.0, 0.5);
  level.Insert(testing::MapPoints(higher));
  for (const Eigen::Vector3d& p : Floor(200, 3.0, 0.01, 5)) {
    const Eigen::Vector3d query = p + Eigen::Vector3d(20.0, 0.0, 0.5);
    const FittedPlane plane = Ask(level, query, &center);
    if (!plane.exists()) continue;
    ++after;
    const double offset_m = plane.normal_world.cast<double>().dot(query - center) - plane.offset_m;
    EXPECT_LT(std::abs(offset_m), 0.1);
  }
  EXPECT_GT(after, 150);
}

}  // namespace
}  // namespace trajlo
