// SPDX-License-Identifier: MIT
#include "core/evaluation/error_causes.h"

#include <cmath>
#include <optional>

#include "core/evaluation/stamp_search.h"
#include "core/io/scan_stamps.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// Velocities come from pairs that are no further apart.
constexpr double kVelocityOver_s = 0.5;

std::optional<Eigen::Vector3d> PositionAt(const TimedPoses& poses, std::int64_t t_ns,
                                          std::int64_t max_gap_ns) {
  const auto at = FindInterval(poses.t_ns, t_ns, max_gap_ns);
  if (!at) return std::nullopt;
  const Eigen::Vector3d begin = poses.T_world_body[at->begin].translation();
  if (at->fraction == 0.0) return begin;
  return begin + at->fraction * (poses.T_world_body[at->begin + 1].translation() - begin);
}

}  // namespace

double StraightLineError_m(const TimedPoses& estimate, const TimedPoses& truth,
                           std::int64_t time_offset_ns, double max_gap_s) {
  const std::int64_t gap_ns = Nanoseconds(MaxGap(estimate.t_ns));
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const auto at =
        FindInterval(truth.t_ns, estimate.t_ns[i] + time_offset_ns, Nanoseconds(max_gap_s));
    if (!at || at->fraction == 0.0) continue;
    const auto begin = PositionAt(estimate, truth.t_ns[at->begin] - time_offset_ns, gap_ns);
    const auto end = PositionAt(estimate, truth.t_ns[at->begin + 1] - time_offset_ns, gap_ns);
    if (!begin || !end) continue;
    const Eigen::Vector3d on_line = *begin + at->fraction * (*end - *begin);
    sum += (estimate.T_world_body[i].translation() - on_line).squaredNorm();
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

ClockDifference ExplainByClocks(const std::vector<PosePair>& pairs) {
  std::vector<Eigen::Vector3d> velocities, errors;
  double all = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Vector3d error = pairs[i].estimate.translation() - pairs[i].truth.translation();
    all += error.squaredNorm();
    if (i == 0 || i + 1 == pairs.size()) continue;
    const PosePair &before = pairs[i - 1], &after = pairs[i + 1];
    const double duration_s = Seconds(after.t_ns - before.t_ns);
    if (!(duration_s > 0.0 && duration_s < kVelocityOver_s)) continue;
    velocities.emplace_back((after.truth.translation() - before.truth.translation()) / duration_s);
    errors.push_back(error);
  }
  if (velocities.empty() || !(all > 0.0)) return {};
  // The alignment took what a mean velocity would explain.
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& velocity : velocities) mean += velocity;
  mean /= static_cast<double>(velocities.size());
  double along = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    along += errors[i].dot(velocities[i] - mean);
    squares += (velocities[i] - mean).squaredNorm();
  }
  if (!(squares > 0.0)) return {};
  return {along / squares, along * along / squares / all};
}

}  // namespace trajlo
