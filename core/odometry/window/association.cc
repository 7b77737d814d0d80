// SPDX-License-Identifier: MIT
#include "core/odometry/window/association.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "core/odometry/window/points_to_world.h"

namespace trajlo {
namespace {

constexpr std::size_t kBatch = MapPyramid::kMaxBatch;

}  // namespace

/// Looks up planes for those of at most kBatch points that need one; returns how many they were.
int SegmentAssociation::Renew(const SegmentPoint* points, std::size_t count,
                              const SegmentMotion& motion, const std::vector<LidarPath>& lidars,
                              const MapPyramid& map, bool has_grown, VoxelKey* cells,
                              Plane* found) {
  std::array<Eigen::Vector3d, kBatch> places;
  PointsToWorld(motion, points, count, places.data());
  std::array<PlaneQuery, kBatch> queries;
  std::array<Plane, kBatch> planes;
  std::array<std::size_t, kBatch> asking;
  std::size_t asked = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (map.IsAround(places[i], cells[i]) && (!has_grown || found[i].exists())) continue;
    cells[i] = map.CellOf(places[i]);
    const LidarPath& lidar = lidars[points[i].lidar];
    const Eigen::Vector3d origin = lidar.begin_world + points[i].alpha * lidar.way_world;
    queries[asked] = {places[i], (places[i] - origin).cast<float>()};
    asking[asked++] = i;
  }
  if (asked == 0) return 0;
  map.FindPlanes(queries.data(), asked, planes.data());
  for (std::size_t i = 0; i < asked; ++i) found[asking[i]] = planes[i];
  return static_cast<int>(asked);
}

int SegmentAssociation::Associate(const std::vector<SegmentPoint>& points,
                                  const std::vector<Eigen::Vector3d>& lidar_origins_body_m,
                                  const SE3& T_begin, const SE3& T_end, const MapPyramid& map,
                                  const StepTolerance& tolerance, ThreadPool* threads,
                                  std::vector<RegistrationPoint>* associated) {
  const bool is_first = cells_.empty();
  if (!is_first && AreNear(T_begin, T_end, T_begin_, T_end_, tolerance)) return 0;
  T_begin_ = T_begin;
  T_end_ = T_end;
  const bool has_grown = std::exchange(map_version_, map.version()) != map.version();
  cells_.resize(points.size(), VoxelKey::Constant(std::numeric_limits<int>::min()));
  planes_.resize(points.size());
  const SegmentMotion motion(T_begin, T_end);
  std::vector<LidarPath> lidars;
  for (const Eigen::Vector3d& origin : lidar_origins_body_m) {
    lidars.push_back({T_begin * origin, T_end * origin - T_begin * origin});
  }
  const std::size_t chunks = (points.size() + kBatch - 1) / kBatch;
  chunk_searched_.resize(chunks);
  threads->ParallelFor(chunks, [&](std::size_t chunk) {
    const std::size_t first = chunk * kBatch;
    chunk_searched_[chunk] = Renew(&points[first], std::min(kBatch, points.size() - first), motion,
                                   lidars, map, has_grown, &cells_[first], &planes_[first]);
  });
  int searched = 0;
  for (const int count : chunk_searched_) searched += count;
  if (searched == 0) return 0;

  associated->clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Plane& plane = planes_[i];
    if (!plane.exists()) continue;
    associated->push_back({points[i].p_body_m.cast<double>(), points[i].alpha, plane.normal_world,
                           plane.offset_m, plane.weight, plane.normal_variance_rad2,
                           plane.coarseness});
  }
  return searched;
}

}  // namespace trajlo
