// SPDX-License-Identifier: MIT
#include "core/odometry/map/map_pyramid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/map_points.h"
#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

/// Voxels of 0.4, 0.8, 1.6 and 3.2 m, to which the scenes below are made.
MapPyramid MakeMap(const PlaneFitOptions& plane, const std::vector<Eigen::Vector3d>& points,
                   int levels = 4) {
  MapPyramidOptions options;
  options.levels = levels;
  options.finest.voxel_size_m = 0.4;
  options.finest.min_point_spacing_m = 0.08;
  options.plane = plane;
  MapPyramid map(options);
  map.Insert(testing::MapPoints(points));
  return map;
}

Plane PlaneAt(const MapPyramid& map, const PlaneQuery& query) {
  Plane plane;
  map.FindPlanes(&query, 1, &plane);
  return plane;
}

/// from, from + step, ... below `to`.
std::vector<double> Steps(double from, double to, double step) {
  std::vector<double> steps;
  const auto count = static_cast<int>(std::ceil((to - from) / step - 1e-9));
  for (int i = 0; i < count; ++i) steps.push_back(from + step * i);
  return steps;
}

TEST(MapPyramid, PrefersAWideThinPlaneForItsNormal) {
  // A noisy floor: small planes of it tilt, and the wide one hardly does. (It does not lie between
  // voxels: there, the points of both would be nearer to each other than their spacing.)
  testing::Random random(13);
  std::vector<Eigen::Vector3d> floor;
  for (int i = 0; i < 20000; ++i) {
    floor.push_back(random.PlaceIn({4, 4, 0}));
    floor.back().z() = 0.2 + random.Gaussian(0.015);
  }
  const MapPyramid wide = MakeMap({}, floor), fine = MakeMap({}, floor, 1);
  const Eigen::Vector3f ray(0.8, 0.0, -0.6);
  double tilt_wide = 0.0, tilt_fine = 0.0;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d query = random.PlaceIn({2, 2, 0}) + 0.2 * Eigen::Vector3d::UnitZ();
    Plane plane = PlaneAt(wide, {query, ray});
    ASSERT_TRUE(plane.exists());
    EXPECT_EQ(plane.coarseness, 1.0);
    EXPECT_GT(plane.weight, 0.5);
    tilt_wide += plane.normal_world.head<2>().norm();
    plane = PlaneAt(fine, {query, ray});
    ASSERT_TRUE(plane.exists());
    tilt_fine += plane.normal_world.head<2>().norm();
  }
  EXPECT_LT(tilt_wide, 0.4 * tilt_fine);
}

TEST(MapPyramid, TakesTheFinePlaneWhereTheWideOneIsNotThin) {
  // Two steps of 0.3 m: at the middle of one, its own level.
  std::vector<Eigen::Vector3d> stairs;
  for (const double x : Steps(-1.5, 1.5, 0.05)) {
    for (const double y : Steps(-1.5, 1.5, 0.05)) {
      stairs.emplace_back(x, y, 0.3 * std::floor(x / 0.5));
    }
  }
  const MapPyramid map = MakeMap({}, stairs);
  Plane plane = PlaneAt(map, {{0.25, 0.0, 0.01}, {0.8F, 0.0F, -0.6F}});
  ASSERT_TRUE(plane.exists());
  EXPECT_NEAR(std::abs(plane.normal_world.z()), 1.0, 1e-6);
  EXPECT_NEAR(plane.offset_m * plane.normal_world.z(), 0.0, 1e-6);
  EXPECT_LT(plane.coarseness, 4.0);
}

TEST(MapPyramid, AWallThatScattersKeepsItsNormal) {
  // Of points that scatter by half a voxel, a few make a plane of their own, tilted by chance.
  testing::Random random(13);
  std::vector<Eigen::Vector3d> wall;
  for (int i = 0; i < 60000; ++i) {
    wall.push_back(random.PlaceIn({0, 4, 4}));
    wall.back().x() = random.Gaussian(0.2);
  }
  const MapPyramid map = MakeMap({}, wall);
  int right = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d query =
        random.PlaceIn({0, 3, 3}) + (i % 2 == 0 ? 0.2 : -0.2) * Eigen::Vector3d::UnitX();
    const Plane plane = PlaneAt(map, {query, {1.0F, 0.0F, 0.0F}});
    right += plane.exists() && std::abs(plane.normal_world.x()) > 0.95 ? 1 : 0;
  }
  EXPECT_GT(right, 75);  // 59 if thin planes were preferred for being thin.
}

TEST(MapPyramid, PlanesThatNoiseMakesAreNoneOnceTheNoiseIsKnown) {
  // One scan line along a wall, with ranges that scatter: around a place, its points spread along
  // the line and along the ray, and make a level plane, which no wall has.
  constexpr double kScatter_m = 0.08;
  testing::Random random(14);
  std::vector<Eigen::Vector3d> line;
  for (const double y : Steps(-4.0, 4.0, 0.01)) {
    line.emplace_back(5.0 + random.Gaussian(kScatter_m), y, random.Gaussian(0.005));
  }
  MapPyramid map = MakeMap({}, line);
  const auto count_level = [&] {
    int level = 0;
    for (const double y : Steps(-3.0, 3.0, 0.05)) {
      const Eigen::Vector3d query(5.0 + random.Gaussian(kScatter_m), y, 0.05);
      // From a height at which the ray does not graze the plane.
      const Plane plane = PlaneAt(map, {query, {1.0F, 0.0F, -0.3F}});
      level += plane.exists() && std::abs(plane.normal_world.z()) > 0.9 ? 1 : 0;
    }
    return level;
  };
  EXPECT_GT(count_level(), 60);
  map.SetScatter(kScatter_m);
  EXPECT_LT(count_level(), 6);
}

TEST(MapPyramid, APlaneThatIsWideBesideTheNoiseStays) {
  std::vector<Eigen::Vector3d> ground;
  testing::Random random(15);
  for (const double x : Steps(-4.0, 4.0, 0.05)) {
    for (const double y : Steps(-4.0, 4.0, 0.05)) ground.emplace_back(x, y, random.Gaussian(0.08));
  }
  MapPyramid map = MakeMap({}, ground);
  map.SetScatter(0.08);
  for (const double y : Steps(-2.0, 2.0, 0.1)) {
    const Plane plane = PlaneAt(map, {{0.0, y, 0.0}, {1.0F, 0.0F, -1.0F}});
    ASSERT_TRUE(plane.exists());
    EXPECT_GT(std::abs(plane.normal_world.z()), 0.9);
  }
}

/// Mean weight of the planes on a ground that is rough by `sigma_m`.
double MeanWeightOnGround(double sigma_m, double scatter_m) {
  std::vector<Eigen::Vector3d> ground;
  testing::Random random(16);
  for (const double x : Steps(-4.0, 4.0, 0.05)) {
    for (const double y : Steps(-4.0, 4.0, 0.05)) {
      ground.emplace_back(x, y, 0.2 + random.Gaussian(sigma_m));
    }
  }
  MapPyramid map = MakeMap({}, ground, 1);
  map.SetScatter(scatter_m);
  double sum = 0.0;
  const std::vector<double> places = Steps(-2.0, 2.0, 0.1);
  for (const double y : places) {
    sum += PlaneAt(map, {{0.0, y, 0.2}, {1.0F, 0.0F, -1.0F}}).weight;
  }
  return sum / static_cast<double>(places.size());
}

TEST(MapPyramid, ThicknessThatNoiseExplainsCostsNoWeight) {
  EXPECT_LT(MeanWeightOnGround(0.02, 0.0), 0.8);
  EXPECT_GT(MeanWeightOnGround(0.02, 0.02), 0.93);
  // What is thicker than that, does.
  EXPECT_LT(MeanWeightOnGround(0.08, 0.02), 0.4);
}

TEST(MapPyramid, APostBeforeAWallIsNotTheWall) {
  std::vector<Eigen::Vector3d> wall_then_post;
  for (const double y : Steps(-4.0, 4.0, 0.05)) {
    for (const double z : Steps(-2.0, 2.0, 0.05)) wall_then_post.emplace_back(5.0, y, z);
  }
  // A post of 0.2 m, its face 0.35 m before the wall: the coarser levels have no room for it.
  for (const double y : Steps(1.5, 1.71, 0.05)) {
    for (const double z : Steps(-2.0, 2.0, 0.05)) wall_then_post.emplace_back(4.65, y, z);
  }
  const MapPyramid map = MakeMap({}, wall_then_post);
  const Eigen::Vector3f ray(1.0, 0.0, 0.0);
  Plane plane = PlaneAt(map, {{4.66, 1.6, 1.0}, ray});
  ASSERT_TRUE(plane.exists());
  EXPECT_NEAR(plane.offset_m * plane.normal_world.x(), 4.65, 0.01);
  plane = PlaneAt(map, {{5.01, -2.0, 1.0}, ray});
  ASSERT_TRUE(plane.exists());
  EXPECT_NEAR(plane.offset_m * plane.normal_world.x(), 5.0, 1e-6);
}

TEST(MapPyramid, PassesOverAPlaneAlongTheRayWhereThereIsAnother) {
  // One scan line over a facade with recesses: level, along the ray. The facade itself, x = 5, is
  // sampled sparsely around it.
  testing::Random random(13);
  std::vector<Eigen::Vector3d> points;
  for (const double y : Steps(-1.0, 1.0, 0.01)) {
    const double x = 5.0 + random.Uniform(0.0, 0.3);
    points.emplace_back(x, y, random.Gaussian(0.003));
  }
  for (double z : {-1.4, -0.7, 0.7, 1.4}) {
    for (const double y : Steps(-2.0, 2.0, 0.03)) {
      points.emplace_back(5.0 + random.Uniform(0.0, 0.3), y, z);
    }
  }
  const MapPyramid map = MakeMap({}, points);
  const Eigen::Vector3d query(5.15, 0.0, 0.0);
  const Eigen::Vector3f ray(1.0, 0.0, 0.0);
  Plane plane = PlaneAt(map, {query, ray});
  ASSERT_TRUE(plane.exists());
  EXPECT_GT(std::abs(plane.normal_world.x()), 0.9);
  PlaneFitOptions options;
  options.min_incidence_sine = 0.0;
  options.max_wide_flatness = 0.0;
  plane = PlaneAt(MakeMap(options, points), {query, ray});
  ASSERT_TRUE(plane.exists());
  EXPECT_GT(std::abs(plane.normal_world.z()), 0.9);
}

TEST(MapPyramid, TakesAPlaneAlongTheRayWhereThereIsNoOther) {
  std::vector<Eigen::Vector3d> ground;
  for (const double x : Steps(-1.0, 1.0, 0.05)) {
    for (const double y : Steps(-1.0, 1.0, 0.05)) ground.emplace_back(x, y, 0.0);
  }
  const MapPyramid map = MakeMap({}, ground);
  Plane plane = PlaneAt(map, {{0, 0, 0}, {0.999F, 0.0F, -0.0447F}});
  ASSERT_TRUE(plane.exists());
  EXPECT_NEAR(std::abs(plane.normal_world.z()), 1.0, 1e-6);
  EXPECT_EQ(plane.coarseness, 1.0);
}

TEST(MapPyramid, WhatWasSeenFromBelowSaysNothingOfWhatIsSeenFromAbove) {
  // A bridge of 0.2 m: its lower face is at 3 m.
  testing::Random random(21);
  std::vector<Eigen::Vector3d> below, above;
  for (int i = 0; i < 20000; ++i) {
    below.push_back(random.PlaceIn({2, 2, 0}) + Eigen::Vector3d(0.0, 0.0, 3.0));
    above.push_back(random.PlaceIn({2, 2, 0}) + Eigen::Vector3d(0.0, 0.0, 3.2));
  }
  MapPyramid map = MakeMap({}, {});
  map.Insert(testing::MapPoints(below, {0.0, 0.0, 0.0}));
  const Eigen::Vector3f up(0.1, 0.0, 1.0), down(0.1, 0.0, -1.0);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d on_bridge = random.PlaceIn({1, 1, 0});
    const PlaneQuery from_below = {on_bridge + 3.0 * Eigen::Vector3d::UnitZ(), up};
    const PlaneQuery from_above = {on_bridge + 3.2 * Eigen::Vector3d::UnitZ(), down};
    EXPECT_NEAR(PlaneAt(map, from_below).normal_world.z(), -1.0, 0.01);
    EXPECT_FALSE(PlaneAt(map, from_above).exists());
  }
  map.Insert(testing::MapPoints(above, {0.0, 0.0, 6.0}));
  const Plane upper = PlaneAt(map, {{0.5, 0.5, 3.2}, down});
  ASSERT_TRUE(upper.exists());
  EXPECT_NEAR(std::abs(upper.normal_world.z()), 1.0, 0.01);
  EXPECT_NEAR(std::abs(upper.offset_m), 3.2, 0.1);
}

}  // namespace
}  // namespace trajlo
