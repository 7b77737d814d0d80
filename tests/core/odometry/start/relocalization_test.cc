// SPDX-License-Identifier: MIT
#include "core/odometry/start/relocalization.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/odometry/segments/choose_evenly.h"
#include "tests/support/bytes_of.h"
#include "tests/support/map_points.h"
#include "tests/support/synthetic_world.h"

namespace trajlo {
namespace {

using testing::Box;
using testing::SyntheticWorld;

/// Other noise than that of the map.
constexpr int kSweep = 77;

/// The world of one sweep, in a room with obstacles, of a sensor that moves by `tau` during it.
SyntheticWorld WorldAt(const SE3& T_begin, const Vector6d& tau = Vector6d::Zero()) {
  SyntheticWorld world;
  world.beams = 16;
  world.columns = 120;
  world.T_world_body = [=](double t) { return T_begin * se3::Exp((t / 0.1 - kSweep) * tau); };
  return world;
}

SE3 PoseAt(double x_m, double y_m, double yaw_rad) {
  return {so3::Exp({0.0, 0.0, yaw_rad}), {x_m, y_m, 0.0}};
}

MapPyramid MapOf(const std::vector<Box>& boxes) {
  MapPyramid map({});
  for (int i = 0; i < 5; ++i) {
    const SE3 T = PoseAt(1.5 * i - 3.0, 0.4 * i, 0.3 * i);
    SyntheticWorld world = WorldAt(T);
    world.boxes = boxes;
    world.beams = 32;
    world.columns = 360;
    std::vector<Eigen::Vector3d> points;
    for (const LidarPoint& point : world.Sweep(i).points) {
      points.push_back(T * point.xyz_m.cast<double>().eval());
    }
    map.Insert(testing::MapPoints(points, T.t));
  }
  return map;
}

SegmentCloud SweepOf(const SyntheticWorld& world) {
  const LidarScan scan = world.Sweep(kSweep);
  SegmentCloud sweep;
  sweep.begin_ns = scan.stamp_ns;
  sweep.end_ns = scan.stamp_ns + 100'000'000;
  sweep.lidar_origins_body_m = {Eigen::Vector3d::Zero()};
  for (const LidarPoint& point : scan.points) {
    const double alpha = 1e-8 * static_cast<double>(point.t_ns - scan.stamp_ns);
    sweep.registration_points.push_back({point.xyz_m, static_cast<float>(alpha)});
  }
  sweep.map_points = sweep.registration_points;
  return sweep;
}

SearchRegion Everywhere() {
  SearchRegion region;
  region.radius_m = 6.0;
  region.q_world_body = {Eigen::Quaterniond::Identity()};
  region.max_turn_rad = M_PI;
  return region;
}

std::optional<SweepMotion> Find(const SegmentCloud& sweep, const MapPyramid& map,
                                const Vector6d& tau = Vector6d::Zero(), int threads = 2) {
  ThreadPool pool(threads);
  return Relocalize(sweep, tau, map, Everywhere(), {}, &pool);
}

const SE3 kPlaces[] = {PoseAt(0, 0, 0), PoseAt(3.5, -2.5, 2.0), PoseAt(-2.0, 3.0, -1.2)};

TEST(Relocalization, FindsAPlaceAnywhereInItsRegion) {
  const MapPyramid map = MapOf(SyntheticWorld().boxes);
  for (const SE3& truth : kPlaces) {
    const auto found = Find(SweepOf(WorldAt(truth)), map);
    ASSERT_TRUE(found);
    EXPECT_LT((found->T_world_begin.t - truth.t).norm(), 0.03);
    EXPECT_LT(found->T_world_begin.q.angularDistance(truth.q), 0.005);
  }
}

TEST(Relocalization, APlaceThatTheRefinementReachesOutsideOfItsRegionIsNone) {
  const MapPyramid map = MapOf(SyntheticWorld().boxes);
  ThreadPool pool(2);
  const auto finds_beside = [&](double distance_m) {
    SearchRegion region;
    region.center_world = kPlaces[0].t + Eigen::Vector3d(distance_m, 0.0, 0.0);
    region.radius_m = 0.4;
    region.q_world_body = {kPlaces[0].q};
    return Relocalize(SweepOf(WorldAt(kPlaces[0])), Vector6d::Zero(), map, region, {}, &pool)
        .has_value();
  };
  EXPECT_TRUE(finds_beside(0.3));
  EXPECT_FALSE(finds_beside(0.5));
  EXPECT_FALSE(finds_beside(1.4));
}

TEST(Relocalization, FindsTheMotionOfASweepThatIsRoughlyKnown) {
  const MapPyramid map = MapOf(SyntheticWorld().boxes);
  Vector6d tau;
  tau << 0.3, 0.0, 0.0, 0.0, 0.0, 0.1;
  for (const SE3& truth : kPlaces) {
    const auto found = Find(SweepOf(WorldAt(truth, tau)), map, 0.8 * tau);
    ASSERT_TRUE(found);
    EXPECT_LT(Minus(truth, found->T_world_begin).cwiseAbs().maxCoeff(), 0.04);
    EXPECT_LT((found->tau - tau).cwiseAbs().maxCoeff(), 0.03);
  }
}

TEST(Relocalization, ASceneThatLooksTheSameTwiceGivesNothing) {
  const std::vector<Box> hall = {{{-9, -6, -1.5}, {9, 6, 5}}};
  SyntheticWorld world = WorldAt(PoseAt(2.0, 1.0, 0.0));
  world.boxes = hall;
  EXPECT_FALSE(Find(SweepOf(world), MapOf(hall)));
}

TEST(Relocalization, ACorridorGivesNothing) {
  const std::vector<Box> corridor = {{{-1e3, -1.5, -1.5}, {1e3, 2.0, 1.5}}};
  SyntheticWorld world = WorldAt(PoseAt(1.0, 0.0, 0.0));
  world.boxes = corridor;
  SegmentCloud sweep = SweepOf(world);
  auto& points = sweep.registration_points;
  points.erase(std::remove_if(points.begin(), points.end(),
                              [](const SegmentPoint& p) { return p.p_body_m.norm() > 20.0F; }),
               points.end());
  EXPECT_FALSE(Find(sweep, MapOf(corridor)));
}

TEST(Relocalization, ASceneThatTheMapDoesNotHaveGivesNothing) {
  const MapPyramid map = MapOf(SyntheticWorld().boxes);
  SyntheticWorld elsewhere = WorldAt(PoseAt(0.5, 0.3, 0.4));
  elsewhere.boxes = {{{-4, -11, -2.5}, {3, 14, 2}}, {{-3, -6, -2.5}, {-1, -5, 1}}};
  EXPECT_FALSE(Find(SweepOf(elsewhere), map));
  // Nor do a map and a sweep without points.
  EXPECT_FALSE(Find(SweepOf(elsewhere), MapPyramid({})));
  EXPECT_FALSE(Find(SegmentCloud(), map));
}

TEST(Relocalization, APlaceWhereTheMapHasNothingForMostPointsIsNotTaken) {
  const MapPyramid map = MapOf(SyntheticWorld().boxes);
  const auto finds_with_twentieths_above_the_ceiling = [&](std::size_t twentieths) {
    SegmentCloud sweep = SweepOf(WorldAt(kPlaces[0]));
    auto& points = sweep.registration_points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (i % 20 < twentieths) points[i].p_body_m = {0.0F, 0.0F, 7.0F + points[i].p_body_m.norm()};
    }
    return Find(sweep, map).has_value();
  };
  EXPECT_TRUE(finds_with_twentieths_above_the_ceiling(7));
  EXPECT_FALSE(finds_with_twentieths_above_the_ceiling(11));
}

/// As those of a hand before the LiDAR, segment after segment.
TEST(Relocalization, FewCellsAreNoPlaceHoweverManyPointsTheyHave) {
  const MapPyramid map = MapOf(SyntheticWorld().boxes);
  SegmentCloud sweep = SweepOf(WorldAt(PoseAt(1.3, -0.6, 1.1)));
  const std::vector<SegmentPoint> all = sweep.registration_points;
  const auto finds_with_ten_points_each_at = [&](std::size_t places) {
    sweep.registration_points.clear();
    for (const SegmentPoint& point : ChooseEvenly(all, places)) {
      sweep.registration_points.insert(sweep.registration_points.end(), 10, point);
    }
    return Find(sweep, map).has_value();
  };
  EXPECT_TRUE(finds_with_ten_points_each_at(300));
  EXPECT_FALSE(finds_with_ten_points_each_at(80));
}

TEST(Relocalization, APlaceBeyondTheRegionIsNotTaken) {
  const MapPyramid map = MapOf(SyntheticWorld().boxes);
  SearchRegion region = Everywhere();
  region.center_world = {-2.0, 3.0, 0.0};
  region.radius_m = 0.5;
  ThreadPool threads(1);
  EXPECT_FALSE(Relocalize(SweepOf(WorldAt(PoseAt(4.5, -3.0, 0))), Vector6d::Zero(), map, region, {},
                          &threads));
}

TEST(Relocalization, IsTheSameToTheBitForAnyNumberOfThreads) {
  const MapPyramid map = MapOf(SyntheticWorld().boxes);
  const SegmentCloud sweep = SweepOf(WorldAt(kPlaces[1]));
  const auto one = Find(sweep, map, Vector6d::Zero(), 1);
  const auto four = Find(sweep, map, Vector6d::Zero(), 4);
  ASSERT_TRUE(one && four);
  EXPECT_TRUE(testing::BytesOf(one->T_world_begin.data(), 7) ==
              testing::BytesOf(four->T_world_begin.data(), 7));
  EXPECT_EQ(one->tau, four->tau);
}

TEST(FindPlaces, HasTheTruePlaceAmongAFewDistinctOnes) {
  const MapPyramid map = MapOf(SyntheticWorld().boxes);
  ThreadPool threads(2);
  for (const SE3& truth : kPlaces) {
    std::vector<Eigen::Vector3d> sweep;
    for (const SegmentPoint& point : SweepOf(WorldAt(truth)).registration_points) {
      sweep.emplace_back(point.p_body_m.cast<double>());
    }
    const std::vector<SE3> places = FindPlaces(sweep, map.finest(), Everywhere(), 10, &threads);
    ASSERT_FALSE(places.empty());
    EXPECT_LE(places.size(), 10u);
    const bool has_truth = std::any_of(places.begin(), places.end(), [&](const SE3& place) {
      return (place.t - truth.t).norm() < 0.8 && place.q.angularDistance(truth.q) < 0.15;
    });
    EXPECT_TRUE(has_truth);
  }
}

}  // namespace
}  // namespace trajlo
