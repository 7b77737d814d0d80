// SPDX-License-Identifier: MIT
#include "core/odometry/window/points_to_world.h"

#include <cstring>

namespace trajlo {
namespace {

using lanes::Lane4;

/// A point begins with p and alpha.
static_assert(sizeof(SegmentPoint) == 5 * sizeof(float));
Lane4 LoadFour(const SegmentPoint& point) {
  lanes::Float4 four;
  std::memcpy(&four, static_cast<const void*>(&point), sizeof(four));
  return __builtin_convertvector(four, Lane4);
}

}  // namespace

void PointsToWorld(const SegmentMotion& motion, const SegmentPoint* points, std::size_t count,
                   Eigen::Vector3d* places_world) {
  std::size_t i = 0;
  for (; i + 4 <= count; i += 4) {
    lanes::Vector3<Lane4> p = {LoadFour(points[i]), LoadFour(points[i + 1]),
                               LoadFour(points[i + 2])};
    Lane4 alpha = LoadFour(points[i + 3]);
    lanes::Transpose(&p.x, &p.y, &p.z, &alpha);
    const lanes::Vector3<Lane4> place = motion.ToWorld(alpha, p);
    for (std::size_t lane = 0; lane < 4; ++lane) {
      places_world[i + lane] = {place.x[lane], place.y[lane], place.z[lane]};
    }
  }
  for (; i < count; ++i) {
    places_world[i] = motion.ToWorld(points[i].alpha, points[i].p_body_m.cast<double>());
  }
}

std::vector<Eigen::Vector3d> PointsToWorld(const SegmentMotion& motion,
                                           const std::vector<SegmentPoint>& points) {
  std::vector<Eigen::Vector3d> places_world(points.size());
  PointsToWorld(motion, points.data(), points.size(), places_world.data());
  return places_world;
}

std::vector<MapPoint> ToMapPoints(const SegmentMotion& motion, const std::vector<LidarPath>& lidars,
                                  const SegmentPoint* points, std::size_t count) {
  std::vector<Eigen::Vector3d> places_world(count);
  PointsToWorld(motion, points, count, places_world.data());
  std::vector<MapPoint> map_points;
  map_points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d sensor_world = lidars[points[i].lidar].At(points[i].alpha);
    map_points.push_back({places_world[i], (sensor_world - places_world[i]).cast<float>()});
  }
  return map_points;
}

}  // namespace trajlo
