// SPDX-License-Identifier: MIT
#include "core/odometry/odometry.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "core/odometry/check_options.h"
#include "core/odometry/first_poses.h"
#include "core/odometry/first_speed.h"
#include "core/odometry/health/belief.h"
#include "core/odometry/segments/join_segments.h"
#include "core/odometry/start/initial_motion.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// Most LiDARs have seen all that is around by then.
constexpr double kFirstSweep_s = 0.1;

/// How many segments the first sweep takes; all of them if they are shorter.
std::size_t FirstSweep(const std::vector<SegmentCloud>& segments) {
  const auto end = std::find_if(segments.begin(), segments.end(), [&](const SegmentCloud& segment) {
    return Seconds(segment.end_ns - segments.front().begin_ns) >= kFirstSweep_s;
  });
  return static_cast<std::size_t>(end - segments.begin()) + (end == segments.end() ? 0 : 1);
}

const OdometryOptions& Checked(const OdometryOptions& options) {
  CheckOptions(options);
  return options;
}

/// What a LiDAR sees must stay in the map, or nothing holds a body that flies high.
OdometryOptions WithMapInRange(OdometryOptions options) {
  double& radius_m = options.map.finest.radius_m;
  radius_m = std::max(radius_m, options.segmenter.max_range_m);
  return options;
}

}  // namespace

Odometry::Odometry(const OdometryOptions& options, const WindowSolverFactory& make_solver)
    : options_(WithMapInRange(Checked(options))),
      make_solver_(make_solver),
      threads_(options.threads),
      segments_(options.segmenter, &threads_,
                [this](SegmentCloud segment) {
                  rig_.Apply(&segment);
                  Take(std::move(segment));
                  TellAhead();
                  if (!is_finishing_) HandOn();
                }),
      rig_(options.segmenter.learn_rig),
      tracker_(options_, make_solver, &threads_, &rig_) {}

void Odometry::AddScan(const LidarScan& scan) { segments_.Add(scan); }

void Odometry::Finish() {
  is_finishing_ = true;
  if (!is_finished_) {
    segments_.Finish();
    if (beginning_) Start();
    if (search_ && search_->HasPoints()) Search(true);
    if (beginning_) Start();
    tracker_.End(std::numeric_limits<std::int64_t>::max());
    TellAhead();
    is_finished_ = true;
  }
  HandOn();
}

/// Calls back for all that is new, when nothing is half done: a callback may throw.
void Odometry::HandOn() {
  while (!windows_to_hand_on_.empty()) {
    const NewWindow window = std::move(windows_to_hand_on_.front());
    windows_to_hand_on_.pop_front();
    if (on_window_) on_window_(window.statistics);
    if (window.solved) on_solved_(window.statistics.index, *window.solved);
  }
  tracker_.poses().HandOn();
}

/// What those ahead of the estimator learn from it.
void Odometry::TellAhead() {
  segments_.CorrectClocks(rig_.Clocks_s());
  if (!trajectory().empty()) segments_.NoteFirstPose(trajectory().poses().front().t_ns);
}

/// A segment, or a gap, goes where it is of use now: to a map that begins, to the window, or to the
/// search for the body.
void Odometry::Take(SegmentCloud cloud) {
  if (beginning_) {
    TakeFirst(std::move(cloud));
    return;
  }
  if (cloud.is_gap && !search_ && !tracker_.was_held()) {
    if (!trajectory().empty()) {
      tracker_.BeginBehindPause(cloud.end_ns);
      return;
    }
    tracker_.ForgetMap(cloud.end_ns);
  }
  if ((cloud.is_gap || !tracker_.HasMap()) && !search_) BeginSearch();
  if (!search_) {
    Step(std::move(cloud));
    return;
  }
  search_->Add(std::move(cloud));
  if (search_->IsDue()) Search(false);
}

/// A map is to begin, with what has been seen and perhaps more.
void Odometry::Begin(Beginning beginning) {
  search_.reset();
  beginning_ = std::move(beginning);
  SegmentCloud& first = beginning_->segments.front();
  // Nothing was measured between the scan before it and its own time.
  if (first.is_instant) first.begin_ns = first.end_ns;
  if (beginning_->IsWhole(options_.initialization)) Start();
}

/// One more segment of the first interval. What a gap cuts short tells little: a sweep that was
/// seen once says nothing of the motion, and is no place that could be found again. The first
/// interval begins behind the gap.
void Odometry::TakeFirst(SegmentCloud cloud) {
  if (cloud.is_gap && beginning_->motion) {
    Start();
    Take(std::move(cloud));
    return;
  }
  if (cloud.is_gap) {
    beginning_->segments.clear();
    return;
  }
  beginning_->segments.push_back(std::move(cloud));
  if (beginning_->IsWhole(options_.initialization)) Start();
}

/// The motion during the first interval, then a map, and a window that begins where that ends.
void Odometry::Start() {
  Beginning beginning = *std::exchange(beginning_, std::nullopt);
  if (beginning.segments.empty()) return;
  if (beginning.motion) {
    beginning.motion = FindFirstSpeed(beginning.segments, beginning.in_interval, *beginning.motion,
                                      options_, make_solver_, &threads_);
  } else {
    FindFirstMotion(&beginning);
    if (beginning.motion->open_direction && !is_finishing_) {
      beginning_ = std::move(beginning);
      return;
    }
  }
  BeginMap(std::move(beginning));
}

/// Where the recording ends within the interval, the motion must be shown, and is in doubt all the
/// same: no window has confirmed it.
void Odometry::FindFirstMotion(Beginning* beginning) {
  beginning->is_cut_short = !beginning->IsWhole(options_.initialization);
  rig_.Begin(&beginning->segments);
  FirstMotion motion =
      MotionOfFirstInterval(JoinSegments(beginning->segments), options_, &threads_);
  if (beginning->is_cut_short) {
    if (!motion.is_shown) motion.velocity.setZero();
    motion.open_direction.reset();
    beginning->flags |= kFlagNoPoints;
  }
  // Scans of one time are too few for a search.
  if (beginning->segments.front().is_instant) motion.open_direction.reset();
  beginning->motion = motion;
  beginning->in_interval = beginning->segments.size();
}

void Odometry::BeginMap(Beginning beginning) {
  std::vector<SegmentCloud>& segments = beginning.segments;
  const FirstMotion& motion = *beginning.motion;
  const SE3& T_begin = beginning.T_world_begin;
  std::size_t in_map = beginning.in_interval;
  const std::vector<SegmentCloud> first(segments.begin(),
                                        segments.begin() + static_cast<std::ptrdiff_t>(in_map));
  if (segments.front().is_instant) {
    in_map = 1;
    tracker_.BeginMap({segments.front()}, {T_begin, T_begin}, motion.velocity, beginning.flags);
  } else if (motion.is_at_rest || beginning.is_cut_short || first.size() < 2) {
    const SegmentCloud interval = JoinSegments(first);
    const SE3 T_end = Plus(T_begin, motion.velocity * interval.Duration_s());
    tracker_.BeginMap({interval}, {T_begin, T_end}, motion.velocity, beginning.flags);
  } else {
    if (!motion.is_steady) in_map = FirstSweep(first);
    BeginInMotion(first, in_map, motion.velocity, T_begin, beginning.flags);
  }
  for (std::size_t k = in_map; k < segments.size(); ++k) Take(std::move(segments[k]));
}

/// A body in motion has a pose for each segment. Where these may be far off, the map is of the
/// first sweep alone: the rest would blur it, and what follows would agree with the blur.
void Odometry::BeginInMotion(const std::vector<SegmentCloud>& segments, std::size_t in_map,
                             const Vector6d& velocity, const SE3& T_begin, unsigned flags) {
  std::vector<SE3> poses = FindFirstPoses(segments, velocity, options_, make_solver_, &threads_);
  for (SE3& T : poses) T = T_begin * T;
  poses.resize(in_map + 1);
  const auto end = segments.begin() + static_cast<std::ptrdiff_t>(in_map);
  const std::vector<SegmentCloud> first(segments.begin(), end);
  const Vector6d last_velocity =
      Minus(poses[in_map], poses[in_map - 1]) / first.back().Duration_s();
  tracker_.BeginMap(first, poses, last_velocity, flags);
}

/// One step of the method, in Tracker::Step; or the body is lost from view, and looked for.
void Odometry::Step(SegmentCloud cloud) {
  std::optional<Window> solved;
  const bool is_wanted = wants_solved_ && wants_solved_(windows_);
  std::optional<WindowStatistics> statistics = tracker_.Step(&cloud, is_wanted ? &solved : nullptr);
  if (!statistics) {
    BeginSearch();
    Take(std::move(cloud));
    return;
  }
  statistics->index = windows_++;
  statistics->milliseconds_segment = segments_.TakeMilliseconds();
  windows_to_hand_on_.push_back({*statistics, std::move(solved)});
}

/// From the end of the window on, nobody knows where the body is.
void Odometry::BeginSearch() { search_.emplace(tracker_.WhereLastSeen(), options_); }

/// Looks for the newest points in the map.
void Odometry::Search(bool is_last) {
  const ReturnSweep sweep = search_->Look(tracker_.map(), &threads_);
  const LastSeen& last = search_->last();
  const double unseen_s = Seconds(sweep.cloud.begin_ns - last.supported_until_ns);
  if (sweep.found && IsWithinReach(last.T_world_body, sweep.found->T_world_begin, unseen_s)) {
    Resume(sweep);
  } else if (!tracker_.was_held()) {
    BeginAgain(sweep);
  } else if (is_last || search_->IsHopeless()) {
    GetLost(sweep);
  }
}

/// The place is found: a new window begins there, and takes what has come since.
void Odometry::Resume(const ReturnSweep& sweep) {
  tracker_.Resume(sweep.cloud, *sweep.found);
  std::vector<SegmentCloud> segments = search_->TakeSegments();
  search_.reset();
  // A scan of one time is in the map already.
  if (sweep.cloud.is_instant) return;
  for (SegmentCloud& segment : segments) Take(std::move(segment));
}

/// There was nothing yet that could be found.
void Odometry::BeginAgain(const ReturnSweep& sweep) {
  tracker_.End(sweep.cloud.begin_ns);
  const unsigned flags = trajectory().empty() ? 0U : kFlagGap;
  Begin({search_->TakeSegments(), tracker_.T_world_begin(), flags});
}

/// The place is not found. What comes now is a recording by itself, placed where the body would be
/// if it had gone on as it did.
void Odometry::GetLost(const ReturnSweep& sweep) {
  tracker_.Lose(sweep.cloud.begin_ns);
  const SE3 T_begin = search_->Predict(sweep.cloud.begin_ns);
  Begin({search_->TakeSegments(), T_begin, kFlagGap | kFlagLost});
}

}  // namespace trajlo
