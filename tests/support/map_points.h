// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/odometry/map/map_point.h"
#include "tests/support/random_poses.h"

namespace trajlo::testing {

/// Evenly in a cube.
inline std::vector<Eigen::Vector3d> RandomPoints(int count, double half_size,
                                                 const Eigen::Vector3d& center, unsigned seed) {
  Random random(seed);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    points.emplace_back(center + random.PlaceIn(Eigen::Vector3d::Constant(half_size)));
  }
  return points;
}

/// Places of which it is not known from where they were seen.
inline std::vector<MapPoint> MapPoints(const std::vector<Eigen::Vector3d>& places_world) {
  std::vector<MapPoint> points;
  for (const Eigen::Vector3d& place : places_world) points.push_back({place});
  return points;
}

/// The same, seen from one place.
inline std::vector<MapPoint> MapPoints(const std::vector<Eigen::Vector3d>& places_world,
                                       const Eigen::Vector3d& sensor_world) {
  std::vector<MapPoint> points;
  for (const Eigen::Vector3d& place : places_world) {
    points.push_back({place, (sensor_world - place).cast<float>()});
  }
  return points;
}

inline std::vector<Eigen::Vector3d> PlacesOf(const std::vector<MapPoint>& points) {
  std::vector<Eigen::Vector3d> places;
  for (const MapPoint& point : points) places.push_back(point.place_world);
  return places;
}

}  // namespace trajlo::testing
