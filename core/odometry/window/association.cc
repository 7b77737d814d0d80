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

std::size_t SegmentAssociation::Begin(const SegmentCloud& cloud, const SE3& T_begin,
                                      const SE3& T_end, const MapPyramid& map,
                                      const StepSize& tolerance) {
  const bool is_first = cells_.empty();
  if (!is_first && AreNear(T_begin, T_end, T_begin_, T_end_, tolerance)) return 0;
  const std::vector<SegmentPoint>& points = cloud.registration_points;
  T_begin_ = T_begin;
  T_end_ = T_end;
  const bool has_grown = std::exchange(inserted_, map.inserted()) != map.inserted();
  const std::int64_t grown = map.inserted() - inserted_at_all_;
  const bool asks_all = is_first || grown > static_cast<std::int64_t>(points.size());
  if (asks_all) inserted_at_all_ = map.inserted();
  cells_.resize(points.size(), VoxelKey::Constant(std::numeric_limits<int>::min()));
  planes_.resize(points.size());
  const std::size_t chunks = (points.size() + kBatch - 1) / kBatch;
  round_.emplace(Round{&points, &map, has_grown, asks_all, SegmentMotion(T_begin, T_end),
                       LidarPaths(cloud.lidar_origins_body_m, T_begin, T_end),
                       std::vector<int>(chunks)});
  return chunks;
}

void SegmentAssociation::Look(std::size_t chunk) {
  const MapPyramid& map = *round_->map;
  const std::size_t first = chunk * kBatch;
  const std::size_t count = std::min(kBatch, round_->points->size() - first);
  const SegmentPoint* points = &(*round_->points)[first];
  VoxelKey* cells = &cells_[first];
  Plane* found = &planes_[first];
  std::array<Eigen::Vector3d, kBatch> places;
  PointsToWorld(round_->motion, points, count, places.data());
  std::array<PlaneQuery, kBatch> queries;
  std::array<Plane, kBatch> planes;
  std::array<std::size_t, kBatch> asking;
  std::size_t asked = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool has_answer = !round_->asks_all && (!round_->has_grown || found[i].exists());
    if (has_answer && map.IsAround(places[i], cells[i])) continue;
    cells[i] = map.CellOf(places[i]);
    const Eigen::Vector3d origin = round_->lidars[points[i].lidar].At(points[i].alpha);
    queries[asked] = {places[i], (places[i] - origin).cast<float>()};
    asking[asked++] = i;
  }
  round_->searched[chunk] = static_cast<int>(asked);
  if (asked == 0) return;
  map.FindPlanes(queries.data(), asked, planes.data());
  for (std::size_t i = 0; i < asked; ++i) found[asking[i]] = planes[i];
}

int SegmentAssociation::Finish(std::vector<RegistrationPoint>* associated) {
  if (!round_) return 0;
  const std::vector<SegmentPoint>& points = *round_->points;
  int searched = 0;
  for (const int count : round_->searched) searched += count;
  round_.reset();
  if (searched == 0) return 0;
  associated->clear();
  associated->reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Plane& plane = planes_[i];
    if (!plane.exists()) continue;
    associated->push_back({points[i].p_body_m.cast<double>(), points[i].alpha, plane.normal_world,
                           plane.offset_m, plane.weight, plane.normal_variance_rad2,
                           plane.coarseness, 0, points[i].lidar});
  }
  return searched;
}

int SegmentAssociation::Associate(const SegmentCloud& cloud, const SE3& T_begin, const SE3& T_end,
                                  const MapPyramid& map, ThreadPool* threads,
                                  std::vector<RegistrationPoint>* associated) {
  const std::size_t chunks = Begin(cloud, T_begin, T_end, map, {});
  threads->ParallelFor(chunks, [&](std::size_t i) { Look(i); });
  return Finish(associated);
}

}  // namespace trajlo
