// SPDX-License-Identifier: MIT
#include "core/odometry/leaving_poses.h"

#include <utility>

#include "core/odometry/health/support.h"
#include "core/odometry/health/window_statistics.h"

namespace trajlo {
namespace {

/// No pose waits longer. Over more time, the begin says little about the end.
constexpr double kLongest_s = 5.0;

/// Of the first `segments` of a window, -1 if there is none.
int PointsOnPlanes(const std::optional<Window>& window, int segments) {
  if (!window) return -1;
  int on_plane = 0;
  for (int k = 0; k < segments; ++k) {
    ForEachPoint(*window, window->At(k), 1, [&](const RegistrationPoint&, bool is_on_plane) {
      on_plane += is_on_plane ? 1 : 0;
    });
  }
  return on_plane;
}

}  // namespace

void LeavingPoses::Leave(const Window& window, const Matrix6d& covariance, bool is_in_doubt) {
  const bool is_lost = lost_at_ns_ && window.begin_ns >= *lost_at_ns_;
  const unsigned flags = window.begin_flags | (is_lost ? kFlagLost : 0U);
  // What comes after a pose that waits waits, too.
  if (waiting_.is_empty() && (!is_in_doubt || final_->trajectory().empty())) {
    final_->Append({{window.begin_ns, window.T_world_begin, flags}, covariance});
    return;
  }
  waiting_.AddPose(window, flags, covariance);
  while (waiting_.Duration_s() > kLongest_s) {
    final_->Append(waiting_.TakeOldest(marginalization_, *motion_prior_));
  }
}

void LeavingPoses::AddSegment(Segment segment) {
  if (!waiting_.is_empty()) waiting_.AddSegment(std::move(segment));
}

void LeavingPoses::AddGap(std::int64_t end_ns) {
  if (!waiting_.is_empty() && waiting_.EndNs() < end_ns) waiting_.AddGap(end_ns);
}

/// Both ends of the stretch are known now. Its poses may be near the right ones, or far off: of the
/// solutions from where they are, and from where the motion prior alone has them between the ends,
/// the one that brings more points onto planes is taken. The present window stays as it is. (The
/// map keeps the planes that were asked for, so later windows may differ by those.)
void LeavingPoses::SmoothBack(const Window& newest, const Estimate& estimate) {
  if (waiting_.is_empty()) return;
  waiting_.Meet(newest);
  if (waiting_.has_jumped()) {
    const std::optional<Window> near = estimate(waiting_.Join(newest));
    const std::optional<Window> far = estimate(waiting_.JoinInterpolated(newest));
    const int segments = waiting_.segments();
    const bool is_far = PointsOnPlanes(far, segments) > PointsOnPlanes(near, segments);
    if (const std::optional<Window>& best = is_far ? far : near) waiting_.SetPoses(*best);
  }
  Settle();
}

void LeavingPoses::Settle() {
  for (const LeavingPose& pose : waiting_.TakeAll()) final_->Append(pose);
}

}  // namespace trajlo
