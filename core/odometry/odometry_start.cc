// SPDX-License-Identifier: MIT
// How a map begins.
#include <utility>
#include <vector>

#include "core/odometry/odometry.h"
#include "core/odometry/segments/join_segments.h"
#include "core/odometry/start/initial_motion.h"
#include "core/odometry/window/enter_map.h"
#include "core/odometry/window/push_segment.h"

namespace trajlo {
namespace {

/// Fewer points make no map: the recording begins again with what comes next.
constexpr std::size_t kFewestToBegin = 20;

}  // namespace

/// A map is to begin, with what has been seen and perhaps more.
void Odometry::Begin(Beginning beginning) {
  search_.reset();
  beginning_ = std::move(beginning);
  SegmentCloud& first = beginning_->segments.front();
  // Nothing was measured between the scan before it and its own time.
  if (first.IsInstant()) first.begin_ns = first.end_ns;
  if (beginning_->IsWhole(options_.initialization)) Start();
}

/// One more segment of the first interval. What a gap cuts short tells little: a sweep that was
/// seen once says nothing of the motion, and is no place that could be found again. The first
/// interval begins behind the gap.
void Odometry::TakeFirst(SegmentCloud cloud) {
  if (cloud.is_gap) {
    beginning_->segments.clear();
    return;
  }
  beginning_->segments.push_back(std::move(cloud));
  if (beginning_->IsWhole(options_.initialization)) Start();
}

/// The motion during the first interval, then a map, and a window that begins where that ends. A
/// constant twist takes the whole interval to the map, if it explains it. Else the map is of the
/// first segment alone: points of a wrong motion would blur it, and what follows would agree with
/// the blur. Where the recording ends within the interval, the motion must be shown, and is in
/// doubt all the same: no window has confirmed it.
void Odometry::Start() {
  Beginning beginning = *std::exchange(beginning_, std::nullopt);
  const bool is_cut_short = !beginning.IsWhole(options_.initialization);
  std::vector<SegmentCloud>& segments = beginning.segments;
  if (segments.empty()) return;
  rig_.Begin(&segments);
  const SegmentCloud interval = JoinSegments(segments);
  FirstMotion motion = MotionOfFirstInterval(interval, options_.initialization, options_.map,
                                             options_.registration, &threads_);
  if (is_cut_short) {
    if (!motion.is_shown) motion.velocity.setZero();
    beginning.flags |= kFlagNoPoints;
  }
  const bool is_whole = motion.is_steady && !segments.front().IsInstant();
  BeginMap(is_whole ? interval : segments.front(), beginning.T_world_begin, motion.velocity,
           beginning.flags);
  if (is_whole) return;
  for (std::size_t k = 1; k < segments.size(); ++k) Take(std::move(segments[k]));
}

/// A map of one cloud alone, and a window that begins where the cloud ends.
void Odometry::BeginMap(const SegmentCloud& cloud, const SE3& T_begin, const Vector6d& velocity,
                        unsigned flags) {
  const double duration_s = cloud.Duration_s();
  const SE3 T_end = T_begin * se3::Exp(velocity * duration_s);
  EnterMap(cloud, T_begin, T_end, &threads_, &map_);
  const ControlPose first = {cloud.begin_ns, T_begin, flags};
  if (duration_s > 0.0 && trajectory().empty() && HasMap()) {
    poses_.Begin(first);
  } else if (duration_s > 0.0) {
    Settle({first});
  }
  window_ = MakeWindow(cloud.end_ns, T_end);
  window_.begin_flags = flags;
  window_.begin_velocity = velocity;
  support_.Begin(cloud.end_ns);
}

/// What was seen once, before a gap, tells neither where the body is behind it nor how it moved:
/// the recording begins behind the gap.
void Odometry::Forget(std::int64_t until_ns) {
  map_ = MapPyramid(options_.map);
  poses_.ForgetFirst();
  window_ = MakeWindow(until_ns, SE3());
}

/// Whether there is something that points can agree with.
bool Odometry::HasMap() const {
  return support_.was_supported() || map_.finest().size() >= kFewestToBegin;
}

}  // namespace trajlo
