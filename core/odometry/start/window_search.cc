// SPDX-License-Identifier: MIT
#include "core/odometry/start/window_search.h"

#include <algorithm>
#include <variant>
#include <vector>

#include "core/odometry/health/window_statistics.h"
#include "core/odometry/segments/join_segments.h"
#include "core/odometry/start/initial_motion.h"
#include "core/scans/nanoseconds.h"
#include "manifolds/se3_interpolation.h"

namespace trajlo {
namespace {

/// How well a place is known that was found in the map.
constexpr double kFoundSigma_m = 0.2;
constexpr double kFoundSigma_rad = 0.05;
/// What looking around may cost: how far, and how long until the next look, as a share of the time
/// in doubt.
constexpr double kFarthest_m = 10.0;
constexpr double kPatience = 0.1;

SearchRegion RegionAround(const SE3& T_world_body, const StepSize& reach,
                          const Eigen::Vector3d& turn_axis_world) {
  SearchRegion region;
  region.center_world = T_world_body.t;
  region.radius_m = std::min(kSamePlace.translation_m + reach.translation_m, kFarthest_m);
  region.q_world_body = {T_world_body.q};
  region.turn_axis_world = turn_axis_world;
  region.max_turn_rad = std::min(kSamePlace.rotation_rad + reach.rotation_rad, M_PI);
  return region;
}

}  // namespace

std::optional<SweepMotion> WindowSearch::Look(const Window& window, const DoubtWatch& doubt,
                                              double agreement,
                                              const Eigen::Vector3d& turn_axis_world,
                                              const MapPyramid& map, ThreadPool* threads) {
  if (window.size() < 2 || window.begin_ns < next_look_ns_) return std::nullopt;
  const std::optional<StepSize> reach = doubt.Reach(agreement);
  if (!reach) return std::nullopt;
  std::vector<SegmentCloud> clouds;
  for (const Segment& segment : window.segments) clouds.push_back(segment.cloud);
  const SegmentCloud sweep = JoinSegments(clouds);
  // A scan of one time shows too little for this.
  if (sweep.map_points.empty() || clouds.back().is_instant) return std::nullopt;
  next_look_ns_ = window.EndNs() + Nanoseconds(kPatience * doubt.Age_s(window.EndNs()));

  // A window that contradicts the map does not tell how the body moves, either.
  const Vector6d tau =
      doubt.IsContradicted(agreement)
          ? sweep.Duration_s() * MotionOfFirstInterval(sweep, options_, threads).velocity
          : Minus(window.EndPose(), window.T_world_begin);
  return Relocalize(sweep, tau, map, RegionAround(window.T_world_begin, *reach, turn_axis_world),
                    options_.registration, threads);
}

void MoveWindow(const SweepMotion& found, Window* window) {
  const SE3 T_world_end = Plus(found.T_world_begin, found.tau);
  const double duration_s = Seconds(window->EndNs() - window->begin_ns);
  window->T_world_begin = found.T_world_begin;
  window->begin_flags |= kFlagJump;
  window->prior = AnchorOfFound(found.T_world_begin);
  window->segments.front().motion = std::monostate();
  for (Segment& segment : window->segments) {
    const double alpha = Seconds(segment.cloud.end_ns - window->begin_ns) / duration_s;
    segment.T_world_end = Interpolate(found.T_world_begin, T_world_end, alpha);
    segment.association = {};
    segment.linearization.reset();
  }
}

MarginalizationPrior AnchorOfFound(const SE3& T_world_found) {
  return MakeAnchor(T_world_found, kFoundSigma_m, kFoundSigma_rad);
}

}  // namespace trajlo
