// SPDX-License-Identifier: MIT
#include "core/odometry/start/place_search.h"

#include <gtest/gtest.h>

#include "tests/support/map_points.h"
#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

/// The floor and the walls of an L-shaped room with two pillars, as points 0.2 m apart.
std::vector<Eigen::Vector3d> MakeRoom() {
  std::vector<Eigen::Vector3d> points;
  const auto add_wall = [&](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const int steps = static_cast<int>((to - from).norm() / 0.2);
    for (int i = 0; i <= steps; ++i) {
      const Eigen::Vector2d at = from + (to - from) * i / steps;
      for (double z = 0.0; z < 3.0; z += 0.2) points.emplace_back(at.x(), at.y(), z);
    }
  };
  const Eigen::Vector2d corners[] = {{0, 0}, {14, 0}, {14, 6}, {7, 6}, {7, 11}, {0, 11}};
  for (int i = 0; i < 6; ++i) add_wall(corners[i], corners[(i + 1) % 6]);
  for (const Eigen::Vector2d& pillar : {Eigen::Vector2d(4, 3), Eigen::Vector2d(10, 4.5)}) {
    add_wall(pillar, pillar + Eigen::Vector2d(0.6, 0));
    add_wall(pillar, pillar + Eigen::Vector2d(0, 0.6));
  }
  for (double x = 0.0; x < 14.0; x += 0.4) {
    for (double y = 0.0; y < (x < 7.0 ? 11.0 : 6.0); y += 0.4) points.emplace_back(x, y, 0.0);
  }
  return points;
}

SearchRegion RegionAround(const Eigen::Vector3d& center_world) {
  SearchRegion region;
  region.center_world = center_world;
  region.radius_m = 3.0;
  region.q_world_body = {Eigen::Quaterniond::Identity()};
  region.max_turn_rad = 1.0;
  return region;
}

TEST(FindPlaces, FindsWhereASweepWasMeasuredAnywhereInTheRegion) {
  const std::vector<Eigen::Vector3d> room = MakeRoom();
  VoxelHashMap map(0.4, 0.1, 100.0);
  map.Insert(testing::MapPoints(room));
  ThreadPool threads(1);
  testing::Random random(3);
  for (int draw = 0; draw < 5; ++draw) {
    const Eigen::Vector3d t = Eigen::Vector3d(3.5, 5.5, 1.25) + random.PlaceIn({2.5, 4.5, 0.75});
    const double yaw_rad = random.Uniform(-0.9, 0.9);
    const SE3 truth(Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ())), t);
    std::vector<Eigen::Vector3d> sweep;
    for (std::size_t i = static_cast<std::size_t>(draw); i < room.size(); i += 7) {
      sweep.push_back(truth.Inverse() * room[i]);
    }
    const Eigen::Vector3d aside = random.PlaceIn({1.5, 1.5, 0.0}) + 0.5 * Eigen::Vector3d::UnitZ();
    const auto places = FindPlaces(sweep, map, RegionAround(t + aside), 3, &threads);
    ASSERT_FALSE(places.empty());
    EXPECT_LT((places.front().t - truth.t).norm(), 0.6) << draw;
    EXPECT_LT(places.front().q.angularDistance(truth.q), 0.15) << draw;
  }
}

TEST(FindPlaces, HasNoPlaceWhereTheMapIsEmptyOrTheSweepIs) {
  const VoxelHashMap empty(0.4, 0.1, 100.0);
  VoxelHashMap map(0.4, 0.1, 100.0);
  map.Insert(testing::MapPoints(MakeRoom()));
  ThreadPool threads(1);
  const SearchRegion region = RegionAround({3, 3, 1});
  EXPECT_TRUE(FindPlaces(MakeRoom(), empty, region, 3, &threads).empty());
  EXPECT_TRUE(FindPlaces({}, map, region, 3, &threads).empty());
  EXPECT_TRUE(FindPlaces(MakeRoom(), map, RegionAround({900, 0, 0}), 3, &threads).empty());
}

}  // namespace
}  // namespace trajlo
