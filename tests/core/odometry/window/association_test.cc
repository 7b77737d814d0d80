// SPDX-License-Identifier: MIT
#include "core/odometry/window/association.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "manifolds/se3_interpolation.h"
#include "tests/support/bytes_of.h"
#include "tests/support/map_points.h"
#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

constexpr double kHalf_m[3] = {8.0, 7.0, 6.0};

/// A place on the walls of a box about the origin, and the axis that the wall is across.
Eigen::Vector3d OnWalls(testing::Random* random, int* axis = nullptr) {
  const int across = static_cast<int>(random->Uniform(0.0, 3.0));
  Eigen::Vector3d p;
  for (int i = 0; i < 3; ++i) p[i] = random->Uniform(-kHalf_m[i], kHalf_m[i]);
  p[across] = p[across] > 0.0 ? kHalf_m[across] : -kHalf_m[across];
  if (axis != nullptr) *axis = across;
  return p;
}

/// How far a place on the wall across `axis` is from the other walls.
double ToNextWall(const Eigen::Vector3d& p, int axis) {
  double distance_m = 100.0;
  for (int i = 0; i < 3; ++i) {
    if (i != axis) distance_m = std::min(distance_m, kHalf_m[i] - std::abs(p[i]));
  }
  return distance_m;
}

MapPyramid BoxMap(int points, unsigned seed, const MapPyramidOptions& options = {}) {
  testing::Random random(seed);
  std::vector<Eigen::Vector3d> walls;
  for (int i = 0; i < points; ++i) walls.push_back(OnWalls(&random));
  MapPyramid map(options);
  map.Insert(testing::MapPoints(walls));
  return map;
}

/// What an association found.
struct Found {
  SegmentAssociation association;
  std::vector<RegistrationPoint> points;
};

/// A segment that moves, and points that lie on the walls exactly at their times.
struct Segment {
  SE3 T_begin, T_end;
  SegmentCloud cloud;
  std::vector<int> axes;

  Segment(int count, unsigned seed) {
    cloud.lidar_origins_body_m = {Eigen::Vector3d::Zero()};
    testing::Random random(seed);
    T_begin = se3::Exp(random.Tangent(0.5, 0.4));
    T_end = Plus(T_begin, random.Tangent(0.2, 0.3));
    for (int i = 0; i < count; ++i) {
      int axis = 0;
      const Eigen::Vector3d p_world = OnWalls(&random, &axis);
      const auto alpha = static_cast<float>(random.Uniform(0.0, 1.0));
      const SE3 T = Interpolate(T_begin, T_end, alpha);
      cloud.registration_points.push_back({(T.Inverse() * p_world).cast<float>(), alpha, 0});
      axes.push_back(axis);
    }
  }
  int Associate(const MapPyramid& map, ThreadPool* threads, Found* found) const {
    return found->association.Associate(cloud, T_begin, T_end, map, threads, &found->points);
  }
};

TEST(SegmentAssociation, FindsTheWallsOfABox) {
  const MapPyramid map = BoxMap(200000, 1);
  const Segment segment(1000, 2);
  ThreadPool threads(1);
  Found found;
  EXPECT_EQ(segment.Associate(map, &threads, &found), 1000);
  EXPECT_GT(found.points.size(), 970u);
  const SegmentMotion motion(segment.T_begin, segment.T_end);
  int inside = 0;
  std::size_t next = 0;
  for (const RegistrationPoint& point : found.points) {
    // In the order of the segment's points.
    while (next < segment.cloud.registration_points.size() &&
           segment.cloud.registration_points[next].p_body_m.cast<double>() != point.p_body_m) {
      ++next;
    }
    ASSERT_LT(next, segment.cloud.registration_points.size());
    EXPECT_EQ(point.alpha, segment.cloud.registration_points[next].alpha);
    EXPECT_NEAR(point.normal_world.norm(), 1.0, 1e-6);
    EXPECT_GT(point.weight, 0.0);
    EXPECT_LE(point.weight, 1.0);
    const Eigen::Vector3d p_world = motion.ToWorld(point.alpha, point.p_body_m);
    if (ToNextWall(p_world, segment.axes[next]) < 3.0) continue;  // Planes lean over the edges.
    ++inside;
    EXPECT_NEAR(point.normal_world.dot(p_world), point.offset_m, 1e-5);
    EXPECT_NEAR(std::abs(point.normal_world[segment.axes[next]]), 1.0, 1e-5);
  }
  EXPECT_GT(inside, 200);
}

TEST(SegmentAssociation, LeavesOutPointsWithoutPlanes) {
  const MapPyramid map = BoxMap(200000, 1);
  Segment segment(200, 3);
  for (std::size_t i = 0; i < segment.cloud.registration_points.size(); i += 2)
    segment.cloud.registration_points[i].p_body_m *= 20.0F;
  ThreadPool threads(1);
  Found found;
  EXPECT_EQ(segment.Associate(map, &threads, &found), 200);
  EXPECT_GT(found.points.size(), 90u);
  EXPECT_LE(found.points.size(), 100u);
  for (const RegistrationPoint& point : found.points) {
    EXPECT_LT(point.p_body_m.norm(), 20.0);
  }
  segment.cloud.registration_points.clear();
  Found nothing;
  EXPECT_EQ(segment.Associate(map, &threads, &nothing), 0);
  EXPECT_TRUE(nothing.points.empty());
}

TEST(SegmentAssociation, IsTheSameToTheByteForAnyNumberOfThreads) {
  const Segment first(2000, 4), second(2000, 5);
  std::vector<RegistrationPoint> expected;
  for (const int count : {1, 2, 5}) {
    // Each with a map of its own, whose planes are fitted while they are looked up, and again after
    // the map has grown.
    MapPyramid map = BoxMap(20000, 1);
    ThreadPool threads(count);
    Found found;
    first.Associate(map, &threads, &found);
    testing::Random random(6);
    std::vector<Eigen::Vector3d> more;
    for (int i = 0; i < 20000; ++i) more.push_back(OnWalls(&random));
    map.Insert(testing::MapPoints(more));
    second.Associate(map, &threads, &found);
    ASSERT_GT(found.points.size(), 1900u);
    if (expected.empty()) expected = found.points;
    ASSERT_EQ(found.points.size(), expected.size());
    EXPECT_TRUE(testing::BytesOf(found.points.data(), found.points.size()) ==
                testing::BytesOf(expected.data(), expected.size()));
  }
}

TEST(SegmentAssociation, LooksUpAgainOnlyPointsThatLeftTheirCell) {
  const MapPyramid map = BoxMap(20000, 1);
  Segment segment(500, 7);
  ThreadPool threads(1);
  Found found;
  EXPECT_EQ(segment.Associate(map, &threads, &found), 500);
  EXPECT_EQ(segment.Associate(map, &threads, &found), 0);
  const Eigen::Vector3d step(0.05, 0.0, 0.0);
  int left = 0;
  const SegmentMotion motion(segment.T_begin, segment.T_end);
  for (const SegmentPoint& point : segment.cloud.registration_points) {
    const Eigen::Vector3d p = motion.ToWorld(point.alpha, point.p_body_m.cast<double>());
    left += map.IsAround(p + step, map.CellOf(p)) ? 0 : 1;
  }
  EXPECT_GT(left, 10);
  EXPECT_LT(left, 250);
  segment.T_begin.t += step;
  segment.T_end.t += step;
  EXPECT_NEAR(segment.Associate(map, &threads, &found), left, 2);
  // As if all had been looked up anew.
  Found anew;
  EXPECT_EQ(segment.Associate(map, &threads, &anew), 500);
  ASSERT_NEAR(static_cast<double>(found.points.size()), static_cast<double>(anew.points.size()), 5);
}

TEST(SegmentAssociation, APointWithoutAPlaneAsksAgainWhenTheMapHasGrown) {
  MapPyramid map = BoxMap(20000, 1);
  const Segment segment(500, 7);
  ThreadPool threads(1);
  Found found;
  segment.Associate(map, &threads, &found);
  const int without = 500 - static_cast<int>(found.points.size());
  ASSERT_GT(without, 0);
  map.Insert({{Eigen::Vector3d(50.0, 50.0, 50.0)}});
  EXPECT_EQ(segment.Associate(map, &threads, &found), without);
  EXPECT_EQ(segment.Associate(map, &threads, &found), 0);
}

TEST(SegmentAssociation, AllAskAgainWhenTheMapHasGrownByAsManyPoints) {
  MapPyramid map = BoxMap(20000, 1);
  const Segment segment(500, 7);
  ThreadPool threads(1);
  Found found;
  segment.Associate(map, &threads, &found);
  const int without = 500 - static_cast<int>(found.points.size());
  // Where the segment sees nothing: what counts is the whole map.
  double x = 50.0;
  const auto grow = [&](int count) {
    for (int i = 0; i < count; ++i) map.Insert({{Eigen::Vector3d(x += 1.0, 50.0, 50.0)}});
  };
  grow(250);
  EXPECT_EQ(segment.Associate(map, &threads, &found), without);
  grow(250);
  EXPECT_EQ(segment.Associate(map, &threads, &found), without);
  grow(1);
  EXPECT_EQ(segment.Associate(map, &threads, &found), 500);
  grow(500);
  EXPECT_EQ(segment.Associate(map, &threads, &found), without);
  EXPECT_EQ(segment.Associate(map, &threads, &found), 0);
}

TEST(SegmentAssociation, ASegmentThatHasNotMovedKeepsItsPlanes) {
  const MapPyramid map = BoxMap(20000, 1);
  const Segment segment(500, 7);
  ThreadPool threads(1);
  Found found;
  const StepSize tolerance = {1e-3, 1e-4};
  const auto associate = [&](double x_m, double yaw_rad) {
    Vector6d tau = Vector6d::Zero();
    tau[0] = x_m;
    tau[5] = yaw_rad;
    const std::size_t chunks = found.association.Begin(segment.cloud, segment.T_begin,
                                                       Plus(segment.T_end, tau), map, tolerance);
    for (std::size_t i = 0; i < chunks; ++i) found.association.Look(i);
    return found.association.Finish(&found.points);
  };
  associate(0.0, 0.0);
  found.points.clear();
  // Two short steps make a long one: what counts is where it asked last.
  EXPECT_EQ(associate(0.9e-3, 0.0), 0);
  EXPECT_TRUE(found.points.empty());
  associate(0.2, 0.0);
  EXPECT_FALSE(found.points.empty());
  found.points.clear();
  EXPECT_EQ(associate(0.2, 0.9e-4), 0);
  associate(0.2, 0.1);
  EXPECT_FALSE(found.points.empty());
}

TEST(SegmentAssociation, MovesPointsInLanesAsOneByOne) {
  // A segment that turns by more than a radian takes the other path.
  testing::Random random(9);
  for (const double angle : {0.0, 0.01, 0.99}) {
    const SE3 T_begin = random.Pose();
    const SegmentMotion motion(T_begin, Plus(T_begin, random.Tangent(angle, 0.5)));
    for (int i = 0; i < 50; ++i) {
      lanes::Lane4 alpha;
      lanes::Vector3<lanes::Lane4> p;
      for (int lane = 0; lane < 4; ++lane) {
        alpha[lane] = random.Uniform(0.0, 1.0);
        p.x[lane] = random.Uniform(-50.0, 50.0);
        p.y[lane] = random.Uniform(-50.0, 50.0);
        p.z[lane] = random.Uniform(-50.0, 50.0);
      }
      const lanes::Vector3<lanes::Lane4> moved = motion.ToWorld(alpha, p);
      for (int lane = 0; lane < 4; ++lane) {
        const Eigen::Vector3d one = motion.ToWorld(alpha[lane], {p.x[lane], p.y[lane], p.z[lane]});
        EXPECT_NEAR(moved.x[lane], one.x(), 1e-12);
        EXPECT_NEAR(moved.y[lane], one.y(), 1e-12);
        EXPECT_NEAR(moved.z[lane], one.z(), 1e-12);
      }
    }
  }
}

TEST(SegmentAssociation, JudgesGrazingByTheRayFromThePointsOwnLidar) {
  // The wall x = 3.1 with recesses of up to 0.3 m, seen densely by one beam of a LiDAR that is 0.8
  // m off the body's origin, and sparsely elsewhere. The dense points lie in the plane of that
  // beam, which is along the rays of the LiDAR, but not along those from the body's origin.
  const Eigen::Vector3d lidar(-0.5, 0.0, 0.6);
  testing::Random random(8);
  std::vector<Eigen::Vector3d> walls;
  const Eigen::Vector3d hit(3.1, 0.0, 0.0);
  const Eigen::Vector3d ray = (hit - lidar).normalized();
  for (double y = -0.6; y < 0.6; y += 0.01) {
    const double depth = random.Uniform(0.0, 0.3);
    const Eigen::Vector3d at = hit + depth / ray.x() * ray;
    walls.emplace_back(at.x(), y, at.z() + random.Gaussian(0.002));
  }
  for (double z : {-1.4, -0.7, 0.7, 1.4}) {
    for (double y = -2.0; y < 2.0; y += 0.03) {
      walls.emplace_back(3.1 + random.Uniform(0.0, 0.3), y, z);
    }
  }
  MapPyramidOptions options;
  options.finest.voxel_size_m = 0.4;
  options.finest.min_point_spacing_m = 0.08;
  MapPyramid map(options);
  map.Insert(testing::MapPoints(walls));
  ThreadPool threads(1);
  const Eigen::Vector3d middle = hit + 0.15 / ray.x() * ray;
  const auto normal = [&](const Eigen::Vector3d& origin) {
    SegmentCloud cloud;
    cloud.lidar_origins_body_m = {Eigen::Vector3d::Zero(), origin};
    cloud.registration_points = {{middle.cast<float>(), 0.5F, 1}};
    Found found;
    found.association.Associate(cloud, SE3(), SE3(), map, &threads, &found.points);
    return found.points.at(0).normal_world;
  };
  EXPECT_GT(std::abs(normal(lidar).x()), 0.9) << "the wall";
  EXPECT_GT(std::abs(normal(Eigen::Vector3d::Zero()).z()), 0.9) << "the plane of the beam";
}

}  // namespace
}  // namespace trajlo
