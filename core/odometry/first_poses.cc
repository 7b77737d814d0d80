// SPDX-License-Identifier: MIT
#include "core/odometry/first_poses.h"

#include <limits>
#include <optional>
#include <utility>

#include "core/odometry/start/settle_poses.h"
#include "core/odometry/tracker.h"

namespace trajlo {
namespace {

/// A slower body may as well be at rest, or turn to and fro. A faster one is not asked: most of
/// what is seen on a road agrees with rest, too.
constexpr double kSlow_m_s = 1.0;

/// As a tracker follows the body, if it can.
std::optional<std::vector<SE3>> Followed(const std::vector<SegmentCloud>& segments,
                                         const Vector6d& velocity, const OdometryOptions& options,
                                         const WindowSolverFactory& make_solver,
                                         ThreadPool* threads) {
  Tracker tracker(options, make_solver, threads);
  tracker.BeginMap({segments.front()}, ConstantTwist({segments.front()}, velocity), velocity, 0);
  for (std::size_t k = 1; k < segments.size(); ++k) {
    SegmentCloud segment = segments[k];
    if (!tracker.Step(&segment)) return std::nullopt;
  }
  tracker.End(std::numeric_limits<std::int64_t>::max());
  std::vector<SE3> poses = {SE3()};
  for (const SegmentCloud& segment : segments) {
    const std::optional<SE3> T = tracker.poses().trajectory().At(segment.end_ns);
    if (!T) return std::nullopt;
    poses.push_back(*T);
  }
  return poses;
}

}  // namespace

std::vector<SE3> ConstantTwist(const std::vector<SegmentCloud>& segments,
                               const Vector6d& velocity) {
  std::vector<SE3> poses = {SE3()};
  for (const SegmentCloud& segment : segments) {
    poses.push_back(Plus(poses.back(), velocity * segment.Duration_s()));
  }
  return poses;
}

std::vector<SE3> FindFirstPoses(const std::vector<SegmentCloud>& segments, const Vector6d& velocity,
                                const OdometryOptions& options,
                                const WindowSolverFactory& make_solver, ThreadPool* threads) {
  const auto settle = [&](const std::vector<SE3>& poses, bool is_coarse) {
    return SettlePoses(segments, poses, is_coarse, options, threads);
  };
  SettledPoses best = settle(ConstantTwist(segments, velocity), true);
  std::vector<Vector6d> begins = {velocity};
  if (velocity.head<3>().norm() < kSlow_m_s) begins.emplace_back(Vector6d::Zero());
  for (const Vector6d& begin : begins) {
    const auto followed = Followed(segments, begin, options, make_solver, threads);
    if (!followed) continue;
    SettledPoses settled = settle(*followed, false);
    if (settled.agreeing > best.agreeing) best = std::move(settled);
  }
  return best.poses;
}

}  // namespace trajlo
