// SPDX-License-Identifier: MIT
#include "core/odometry/window/association.h"

#include <algorithm>

#include "manifolds/se3_interpolation.h"

namespace trajlo {

int SegmentAssociation::Associate(const std::vector<SegmentPoint>& points, const SE3& T_begin,
                                  const SE3& T_end, const MapPyramid& map,
                                  const AssociationOptions& options, double threshold_m, bool renew,
                                  ThreadPool* threads, std::vector<RegistrationPoint>* associated) {
  entries_.resize(points.size());
  const SegmentMotion motion(T_begin, T_end);
  const double reach_m = options.reach_in_thresholds * threshold_m;

  constexpr std::size_t kChunk = 64;
  const std::size_t chunks = (points.size() + kChunk - 1) / kChunk;
  chunk_searched_.assign(chunks, 0);
  threads->ParallelFor(chunks, [&](std::size_t chunk) {
    const std::size_t last = std::min(points.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < last; ++i) {
      Entry& entry = entries_[i];
      const Eigen::Vector3d p_world =
          motion.ToWorld(points[i].alpha, points[i].p_body_m.cast<double>());
      const bool stands =
          entry.state == Entry::State::kPlane || (entry.state == Entry::State::kNone && !renew);
      if (stands && (p_world - entry.looked_up_at).norm() <= entry.keep_m) continue;
      entry.looked_up_at = p_world;
      ++chunk_searched_[chunk];
      const Eigen::Vector3d sensor_world = motion.ToWorld(points[i].alpha, Eigen::Vector3d::Zero());
      const Eigen::Vector3d ray_world = (p_world - sensor_world).normalized();
      const bool found = map.FindPlane(p_world, ray_world, options.plane, reach_m, &entry.plane);
      entry.state = found ? Entry::State::kPlane : Entry::State::kNone;
      entry.keep_m =
          options.reassociate_distance_m * (found ? entry.plane.scale : map.coarsest_scale());
    }
  });

  int searched = 0;
  for (const int count : chunk_searched_) searched += count;
  if (searched == 0) return 0;  // No plane has changed.
  associated->clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Entry& entry = entries_[i];
    if (entry.state != Entry::State::kPlane) continue;
    associated->push_back({points[i].p_body_m.cast<double>(), points[i].alpha,
                           entry.plane.normal_world, entry.plane.offset_m, entry.plane.weight});
  }
  return searched;
}

}  // namespace trajlo
