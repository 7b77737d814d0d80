// SPDX-License-Identifier: MIT
// When a doubt is over: what was estimated in it is estimated once more.
#include <optional>
#include <vector>

#include "core/odometry/health/support.h"
#include "core/odometry/odometry.h"

namespace trajlo {
namespace {

/// No pose waits longer. Over more time, the begin says little about the end.
constexpr double kLongest_s = 5.0;

int PointsOnPlanes(const Window& window, int segments) {
  int on_plane = 0;
  for (int k = 0; k < segments; ++k) {
    ForEachPoint(window, window.At(k), 1, [&](const RegistrationPoint&, bool is_on_plane) {
      on_plane += is_on_plane ? 1 : 0;
    });
  }
  return on_plane;
}

}  // namespace

/// Poses that leave the window while it is not sure where the body is wait until it is.
bool Odometry::MustWait() const {
  if (!hindsight_.is_empty()) return true;
  return support_.was_supported() && !trajectory().empty() && !doubt_.IsSure();
}

void Odometry::Wait(const LeavingPose& leaving) {
  hindsight_.AddPose(window_, leaving.pose.flags, leaving.covariance);
  while (hindsight_.Duration_s() > kLongest_s) {
    Settle(hindsight_.TakeOldest(options_.marginalization));
  }
}

/// Both ends of the stretch are known now. Its poses may be near the right ones, or far off: of the
/// solutions from where they are, and from where the motion prior alone has them between the ends,
/// the one that brings more points onto planes is taken. The present window stays as it is. (The
/// map keeps the planes that were asked for, so later windows may differ by those.)
void Odometry::LookBack(WindowStatistics* statistics) {
  hindsight_.Meet(window_);
  if (hindsight_.has_jumped()) {
    const std::optional<Window> near = Reestimate(hindsight_.Join(window_), statistics);
    const std::optional<Window> far = Reestimate(hindsight_.JoinInterpolated(window_), statistics);
    const auto on_planes = [&](const std::optional<Window>& joined) {
      return joined ? PointsOnPlanes(*joined, hindsight_.segments()) : -1;
    };
    const std::optional<Window>& best = on_planes(far) > on_planes(near) ? far : near;
    if (best) hindsight_.SetPoses(*best);
  }
  SettleStretch();
}

/// As any other window; nothing if that fails.
std::optional<Window> Odometry::Reestimate(Window joined, WindowStatistics* statistics) {
  motion_prior_.Apply(&joined);
  const std::vector<SE3> start = joined.Poses();
  WindowStatistics rounds;
  estimator_.AssociateAndSolve(map_, &joined, &rounds);
  estimator_.LeaveOutUnsupported(start, &joined, &rounds);
  statistics->milliseconds_associate += rounds.milliseconds_associate;
  statistics->milliseconds_solve += rounds.milliseconds_solve;
  if (!rounds.is_finite) return std::nullopt;
  return joined;
}

/// The poses that wait are final as they are.
void Odometry::SettleStretch() {
  for (const LeavingPose& leaving : hindsight_.TakeAll()) Settle(leaving);
}

}  // namespace trajlo
