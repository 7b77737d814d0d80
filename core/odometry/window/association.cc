// SPDX-License-Identifier: MIT
#include "core/odometry/window/association.h"

#include <algorithm>
#include <array>

#include "manifolds/se3_interpolation.h"

namespace trajlo {
namespace {

/// A segment lies where it did if no point of it, up to this far away, has moved by more than this.
constexpr double kSamePlace_m = 0.003;
constexpr double kLeverArm_m = 20.0;

/// Looks up the planes of at most kMaxBatch points; returns how many have one.
std::size_t AssociateBatch(const SegmentPoint* points, std::size_t count,
                           const std::vector<Eigen::Vector3d>& lidar_origins_body_m,
                           const SegmentMotion& motion, const MapPyramid& map,
                           RegistrationPoint* found) {
  std::array<Eigen::Vector3d, MapPyramid::kMaxBatch> places_world, rays_world;
  for (std::size_t i = 0; i < count; ++i) {
    const double alpha = points[i].alpha;
    places_world[i] = motion.ToWorld(alpha, points[i].p_body_m.cast<double>());
    const Eigen::Vector3d lidar_world =
        motion.ToWorld(alpha, lidar_origins_body_m[points[i].lidar]);
    rays_world[i] = (places_world[i] - lidar_world).normalized();
  }
  std::array<Plane, MapPyramid::kMaxBatch> planes;
  map.FindPlanes(places_world.data(), rays_world.data(), count, planes.data());
  std::size_t found_count = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!planes[i].exists()) continue;
    found[found_count++] = {points[i].p_body_m.cast<double>(), points[i].alpha,
                            planes[i].normal_world, planes[i].offset_m, planes[i].weight};
  }
  return found_count;
}

}  // namespace

bool SegmentAssociation::HasMoved(const SE3& T_begin, const SE3& T_end) const {
  const auto moved_by = [](const SE3& a, const SE3& b) {
    return (a.t - b.t).norm() + kLeverArm_m * a.q.angularDistance(b.q);
  };
  return moved_by(T_begin_, T_begin) > kSamePlace_m || moved_by(T_end_, T_end) > kSamePlace_m;
}

int SegmentAssociation::Associate(const std::vector<SegmentPoint>& points,
                                  const std::vector<Eigen::Vector3d>& lidar_origins_body_m,
                                  const SE3& T_begin, const SE3& T_end, const MapPyramid& map,
                                  ThreadPool* threads, std::vector<RegistrationPoint>* associated) {
  if (is_associated_ && !HasMoved(T_begin, T_end)) return 0;
  is_associated_ = true;
  T_begin_ = T_begin;
  T_end_ = T_end;
  const SegmentMotion motion(T_begin, T_end);
  constexpr std::size_t kChunk = MapPyramid::kMaxBatch;
  const std::size_t chunks = (points.size() + kChunk - 1) / kChunk;
  associated->resize(points.size());
  chunk_found_.resize(chunks);
  threads->ParallelFor(chunks, [&](std::size_t chunk) {
    const std::size_t first = chunk * kChunk;
    chunk_found_[chunk] = AssociateBatch(&points[first], std::min(kChunk, points.size() - first),
                                         lidar_origins_body_m, motion, map, &(*associated)[first]);
  });
  // The chunks close up.
  std::size_t end = 0;
  for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
    const auto first = associated->begin() + static_cast<std::ptrdiff_t>(chunk * kChunk);
    const auto last = first + static_cast<std::ptrdiff_t>(chunk_found_[chunk]);
    if (end < chunk * kChunk) {
      std::move(first, last, associated->begin() + static_cast<std::ptrdiff_t>(end));
    }
    end += chunk_found_[chunk];
  }
  associated->resize(end);
  return static_cast<int>(points.size());
}

}  // namespace trajlo
