// SPDX-License-Identifier: MIT
#include "core/estimation/association.h"

#include <algorithm>

namespace trajlo {

SegmentAssociation::Counts SegmentAssociation::Associate(
    const std::vector<SegmentPoint>& points, const SE3& T_begin, const SE3& T_end,
    const PointMap& map, const AssociationOptions& options, double threshold_m, bool renew,
    ThreadPool* threads) {
  entries_.resize(points.size());
  const Vector6d tau = Minus(T_end, T_begin);
  const double keep = options.reassociate_distance_m * options.reassociate_distance_m;

  constexpr std::size_t kChunk = 64;
  const std::size_t chunks = (points.size() + kChunk - 1) / kChunk;
  chunk_searched_.assign(chunks, 0);
  threads->ParallelFor(chunks, [&](std::size_t chunk) {
    Neighbors neighbors;
    const std::size_t last = std::min(points.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < last; ++i) {
      Entry& entry = entries_[i];
      const Eigen::Vector3d p_world =
          T_begin * (se3::Exp(points[i].alpha * tau) * points[i].p_body_m.cast<double>());
      const bool stands = entry.state == Entry::State::kPlane ||
                          (entry.state == Entry::State::kNone && !renew);
      if (stands && (p_world - entry.looked_up_at).squaredNorm() <= keep) continue;
      entry.looked_up_at = p_world;
      map.Nearest(p_world, options.plane.neighbors, &neighbors);
      ++chunk_searched_[chunk];
      const bool found = FitPlane(neighbors, options.plane, &entry.plane);
      entry.state = found ? Entry::State::kPlane : Entry::State::kNone;
      if (found) entry.distance_m = std::sqrt(neighbors.squared_distance[0]);
    }
  });

  Counts counts;
  for (const int searched : chunk_searched_) counts.searched += searched;
  active_.clear();
  const auto reach = static_cast<float>(options.reach_in_thresholds * threshold_m);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Entry& entry = entries_[i];
    if (entry.state != Entry::State::kPlane || entry.distance_m > reach) continue;
    active_.push_back({points[i].p_body_m.cast<double>(), points[i].alpha,
                       entry.plane.normal_world, entry.plane.offset_m, 1.0});
  }
  counts.associated = static_cast<int>(active_.size());
  return counts;
}

}  // namespace trajlo
