// SPDX-License-Identifier: MIT
#include "core/evaluation/relative_pairs.h"

#include <algorithm>
#include <cmath>

#include "core/evaluation/pose_errors.h"
#include "core/evaluation/stamp_search.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

double Distance(const Eigen::Affine3d& a, const Eigen::Affine3d& b) {
  return (b.translation() - a.translation()).norm();
}

double AngleDeg(const Eigen::Affine3d& a, const Eigen::Affine3d& b) {
  return RotationAngleDeg(a.linear().transpose() * b.linear());
}

/// From index 0 on, each piece ending where the motion from pose to pose adds up to `delta`.
template <typename Motion>
IndexPairs PiecesInARow(const std::vector<Eigen::Affine3d>& poses, double delta,
                        const Motion& motion) {
  IndexPairs pairs;
  std::size_t first = 0;
  double sum = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    sum += motion(poses[i - 1], poses[i]);
    if (sum < delta) continue;
    pairs.push_back({first, i});
    first = i;
    sum = 0.0;
  }
  return pairs;
}

}  // namespace

IndexPairs PairsOverFrames(std::size_t frames, std::size_t delta, bool all) {
  IndexPairs pairs;
  if (delta == 0) return pairs;
  for (std::size_t i = 0; i + delta < frames; i += all ? 1 : delta) pairs.push_back({i, i + delta});
  return pairs;
}

IndexPairs ConsecutivePairsOverDistance(const std::vector<Eigen::Affine3d>& poses, double delta_m) {
  return PiecesInARow(poses, delta_m, Distance);
}

IndexPairs AllPairsOverDistance(const std::vector<Eigen::Affine3d>& poses, double delta_m,
                                double tolerance) {
  std::vector<double> path(poses.size(), 0.0);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    path[i] = path[i - 1] + Distance(poses[i - 1], poses[i]);
  }
  IndexPairs pairs;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    const auto off = [&](std::size_t j) { return std::abs(path[j] - path[i] - delta_m); };
    const auto begin = path.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    auto after = std::lower_bound(begin, path.end(), path[i] + delta_m);
    if (after == path.end()) --after;
    std::size_t j = static_cast<std::size_t>(after - path.begin());
    if (j > i + 1 && off(j - 1) <= off(j)) --j;
    // Of poses that stand still at the same path length, the first.
    while (j > i + 1 && path[j - 1] == path[j]) --j;
    if (off(j) <= tolerance * delta_m) pairs.push_back({i, j});
  }
  return pairs;
}

IndexPairs ConsecutivePairsOverAngle(const std::vector<Eigen::Affine3d>& poses, double delta_deg) {
  return PiecesInARow(poses, delta_deg, AngleDeg);
}

IndexPairs AllPairsOverTime(const std::vector<std::int64_t>& t_ns, double delta_s,
                            double tolerance) {
  const std::int64_t delta_ns = Nanoseconds(delta_s);
  const std::int64_t tolerance_ns = Nanoseconds(tolerance * delta_s);
  IndexPairs pairs;
  for (std::size_t i = 0; i < t_ns.size(); ++i) {
    const std::size_t j = Nearest(t_ns, t_ns[i] + delta_ns);
    if (j <= i || j + 1 == t_ns.size()) continue;
    if (std::abs(t_ns[j] - t_ns[i] - delta_ns) <= tolerance_ns) pairs.push_back({i, j});
  }
  return pairs;
}

}  // namespace trajlo
