// SPDX-License-Identifier: MIT
// When the points do not hold the body any more, and how it finds its place again.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "core/odometry/health/belief.h"
#include "core/odometry/odometry.h"
#include "core/odometry/segments/join_segments.h"
#include "core/odometry/start/initial_motion.h"
#include "core/odometry/start/relocalization.h"
#include "core/odometry/weights/innovation.h"
#include "core/odometry/window/enter_map.h"
#include "core/odometry/window/push_segment.h"
#include "core/scans/nanoseconds.h"
#include "manifolds/se3_interpolation.h"

namespace trajlo {
namespace {

/// How well a place is known that was found in the map.
constexpr double kFoundSigma_m = 0.2;
constexpr double kFoundSigma_rad = 0.05;
/// From here a window finds its place by itself.
constexpr StepSize kSamePlace = {0.5, 0.12};
/// What looking around may cost: how far, and how long until the next look, as a share of the time
/// in doubt.
constexpr double kFarthest_m = 10.0;
constexpr double kPatience = 0.1;

}  // namespace

/// The points contradict the map where the motion prior led them: the body began to turn as the
/// prior did not foresee. (By some degrees within a segment; no body is flung so far aside.) They
/// look again while its attitude may be anything near. If they agree better then, and hold it, the
/// prior follows. (A hand before the LiDAR has few points, which agree with whatever is near.)
void Odometry::LookAgain(const std::vector<SE3>& predicted, WindowStatistics* statistics) {
  Window first = window_;
  window_.BeginAgainAt(predicted);
  Segment& newest = window_.segments.back();
  newest.registration = {};
  newest.association = {};
  motion_prior_.UntieRotation(&window_);
  WindowStatistics again;
  again.restless = statistics->restless;
  // Both looks take time, whichever is kept.
  again.milliseconds_associate = statistics->milliseconds_associate;
  again.milliseconds_solve = statistics->milliseconds_solve;
  estimator_.AssociateAndSolve(map_, &window_, &again);
  const bool is_better = again.is_finite && again.agreement > statistics->agreement;
  if (is_better && !IsUnsupported(window_, newest)) {
    motion_prior_.Apply(&window_);
    motion_prior_.Follow(MeasureInnovation(window_, predicted.back()));
    motion_prior_.Apply(&window_);
    *statistics = again;
  } else {
    window_ = std::move(first);
    statistics->milliseconds_associate = again.milliseconds_associate;
    statistics->milliseconds_solve = again.milliseconds_solve;
  }
}

/// About which the body may have turned most while its points did not hold it. A body on a rope
/// turns about no vertical; but where only the floor was in view, its tilt is known.
Eigen::Vector3d Odometry::TurnAxis() const {
  return doubt_.open_axis_world().value_or(attitude_.VerticalInWorld());
}

/// In doubt, what the window has seen is looked for in the map, around where the body seems to be.
/// Where it is clearly found, the body is. While the doubt lasts, the map does not grow: a body at
/// the right place would soon be out of it. (A scan of one time shows too little for this.)
void Odometry::LookAround(double agreement) {
  if (window_.size() < 2 || window_.begin_ns < next_look_ns_) return;
  const std::optional<StepSize> reach = doubt_.Reach(agreement);
  if (!reach) return;
  std::vector<SegmentCloud> clouds;
  for (const Segment& segment : window_.segments) clouds.push_back(segment.cloud);
  const SegmentCloud sweep = JoinSegments(clouds);
  if (sweep.map_points.empty() || clouds.back().IsInstant()) return;
  next_look_ns_ = window_.EndNs() + std::llround(1e9 * kPatience * doubt_.Age_s(window_.EndNs()));

  SearchRegion region;
  region.center_world = window_.T_world_begin.t;
  region.radius_m = std::min(kSamePlace.translation_m + reach->translation_m, kFarthest_m);
  region.q_world_body = {window_.T_world_begin.q};
  region.turn_axis_world = TurnAxis();
  region.max_turn_rad = std::min(kSamePlace.rotation_rad + reach->rotation_rad, M_PI);
  // A window that contradicts the map does not tell how the body moves, either.
  const Vector6d tau =
      doubt_.IsContradicted(agreement)
          ? sweep.Duration_s() * MotionOfFirstInterval(sweep, options_.initialization, options_.map,
                                                       options_.registration, &threads_)
                                     .velocity
          : Minus(window_.EndPose(), window_.T_world_begin);
  const auto found = Relocalize(sweep, tau, map_, region, options_.registration, &threads_);
  if (!found) return;
  doubt_.Dispel(window_.EndNs());
  if (MeasureStep(window_.T_world_begin, found->T_world_begin).IsWithin(kSamePlace)) return;
  MoveWindow(*found);
}

/// To where its points were found. The next solve begins there.
void Odometry::MoveWindow(const SweepMotion& found) {
  const SE3 T_world_end = Plus(found.T_world_begin, found.tau);
  const double duration_s = Seconds(window_.EndNs() - window_.begin_ns);
  window_.T_world_begin = found.T_world_begin;
  window_.begin_flags |= kFlagJump;
  window_.prior = MakeAnchor(found.T_world_begin, kFoundSigma_m, kFoundSigma_rad);
  window_.segments.front().motion = std::monostate();
  for (Segment& segment : window_.segments) {
    const double alpha = Seconds(segment.cloud.end_ns - window_.begin_ns) / duration_s;
    segment.T_world_end = Interpolate(found.T_world_begin, T_world_end, alpha);
    segment.association = {};
    segment.linearization.reset();
  }
  support_.Supported(window_.EndNs());
  loss_watch_ = LossWatch();
}

/// Whether the newest points do not hold the window, and did not for so long that its prediction is
/// no place to start from.
bool Odometry::IsBlind() const {
  return IsUnsupported(window_, window_.segments.back()) &&
         support_.IsBlind(window_.EndNs(), motion_prior_.density());
}

/// The newest segment leaves the window, and is looked for in the map. (Where points were moved by
/// the prediction as they came, see Deskewing, they stay so.)
void Odometry::TakeBackAndSearch(const std::vector<SE3>& predicted) {
  SegmentCloud cloud = std::move(window_.segments.back().cloud);
  Revert(predicted, &window_);
  window_.segments.pop_back();
  BeginSearch();
  Take(std::move(cloud));
}

/// The newest segment that its points hold. One that sees a new part of the world is held as soon
/// as the map has grown there.
void Odometry::NoteSupport() {
  for (std::size_t k = window_.segments.size(); k-- > 0;) {
    if (IsUnsupported(window_, window_.segments[k])) continue;
    support_.Supported(window_.segments[k].cloud.end_ns);
    return;
  }
}

/// From the end of the window on, nobody knows where the body is.
void Odometry::BeginSearch() {
  search_.emplace(LastSeen{support_.supported_until_ns(), window_.EndNs(), window_.EndPose(),
                           window_.EndVelocity(), motion_prior_.density(), TurnAxis()},
                  attitude_, options_.segmenter.interval_s, options_.initialization, options_.map,
                  options_.registration);
}

/// Looks for the newest points in the map.
void Odometry::Search(bool is_last) {
  const ReturnSweep sweep = search_->Look(map_, &threads_);
  const LastSeen& last = search_->last();
  const double unseen_s = Seconds(sweep.cloud.begin_ns - last.supported_until_ns);
  if (sweep.T_world_begin && IsWithinReach(last.T_world_body, *sweep.T_world_begin, unseen_s)) {
    Resume(sweep);
  } else if (!support_.was_supported()) {
    BeginAgain(sweep);
  } else if (is_last || search_->IsHopeless()) {
    GetLost(sweep);
  }
}

/// There was nothing yet that could be found.
void Odometry::BeginAgain(const ReturnSweep& sweep) {
  SettleWindow(sweep.cloud.begin_ns);
  SettleStretch();
  const unsigned flags = trajectory().empty() ? 0U : kFlagGap;
  Begin({search_->TakeSegments(), window_.T_world_begin, flags});
}

/// The place is found: a new window begins there, and takes what has come since.
void Odometry::Resume(const ReturnSweep& sweep) {
  SettleWindow(sweep.cloud.begin_ns);
  if (sweep.cloud.IsInstant()) SettleStretch();
  if (!hindsight_.is_empty() && hindsight_.EndNs() < sweep.cloud.begin_ns) {
    hindsight_.AddGap(sweep.cloud.begin_ns);
  }
  const SE3& T_world_begin = *sweep.T_world_begin;
  window_ = MakeWindow(sweep.cloud.begin_ns, T_world_begin);
  window_.prior = MakeAnchor(T_world_begin, kFoundSigma_m, kFoundSigma_rad);
  window_.begin_flags = kFlagGap;
  std::vector<SegmentCloud> segments = search_->TakeSegments();
  if (sweep.cloud.end_ns > sweep.cloud.begin_ns) {
    window_.begin_velocity = sweep.tau / sweep.cloud.Duration_s();
  } else {
    // The mean velocity since the points held the body: all of that is settled by now.
    const std::int64_t seen_ns = search_->last().supported_until_ns;
    const SE3 T_world_seen = trajectory().At(seen_ns).value_or(T_world_begin);
    window_.begin_velocity =
        Minus(T_world_begin, T_world_seen) / Seconds(sweep.cloud.begin_ns - seen_ns);
    EnterMap(sweep.cloud, T_world_begin, T_world_begin, &threads_, &map_);
    segments.clear();
  }
  support_.Supported(sweep.cloud.begin_ns);
  loss_watch_ = LossWatch();
  search_.reset();
  for (SegmentCloud& segment : segments) Take(std::move(segment));
}

/// The place is not found. What comes now is a recording by itself, placed where the body would be
/// if it had gone on as it did.
void Odometry::GetLost(const ReturnSweep& sweep) {
  if (!lost_at_ns_) lost_at_ns_ = support_.supported_until_ns() + 1;
  SettleWindow(sweep.cloud.begin_ns);
  SettleStretch();
  map_ = MapPyramid(options_.map);
  // What was usual there says nothing here.
  inlier_watch_ = InlierWatch();
  loss_watch_ = LossWatch();
  support_ = SupportWatch();
  doubt_ = DoubtWatch();
  const SE3 T_begin = search_->Predict(sweep.cloud.begin_ns);
  Begin({search_->TakeSegments(), T_begin, kFlagGap | kFlagLost});
}

}  // namespace trajlo
