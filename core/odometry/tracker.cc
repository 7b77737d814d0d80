// SPDX-License-Identifier: MIT
#include "core/odometry/tracker.h"

#include <algorithm>
#include <utility>

#include "core/odometry/health/belief.h"
#include "core/odometry/parallel/side_task.h"
#include "core/odometry/weights/innovation.h"
#include "core/odometry/window/covariance.h"
#include "core/odometry/window/enter_map.h"
#include "core/odometry/window/point_scatter.h"
#include "core/odometry/window/push_segment.h"
#include "core/scans/nanoseconds.h"
#include "core/timing/stopwatch.h"

namespace trajlo {
namespace {

/// Fewer points make no map: the recording begins again with what comes next.
constexpr std::size_t kFewestToBegin = 20;
/// The window keeps so few segments where fewer of the newest points than this share have a plane.
constexpr int kShortWindow = 2;
constexpr double kSeesMap = 0.5;

/// Points enter the map when they leave the window. In a fast turn that comes too late: the newest
/// ones see what only the window has seen. Then the window is shorter, and the map grows with them.
int SegmentsToKeep(const Segment& newest, int most) {
  const auto all = static_cast<double>(newest.cloud.registration_points.size());
  const bool sees_map = static_cast<double>(newest.points.size()) >= kSeesMap * all;
  return sees_map ? most - 1 : std::min(kShortWindow, most - 1);
}

}  // namespace

Tracker::Tracker(const OdometryOptions& options, const WindowSolverFactory& make_solver,
                 ThreadPool* threads, RigCalibration* rig)
    : options_(options),
      threads_(threads),
      rig_(rig),
      map_(options.map),
      motion_prior_(options.motion_prior),
      estimator_(options.registration, options.solver, make_solver, threads),
      window_search_(options_),
      leaving_(options.marginalization, &motion_prior_, &poses_) {}

void Tracker::BeginMap(const std::vector<SegmentCloud>& segments, const std::vector<SE3>& poses,
                       const Vector6d& velocity, unsigned flags) {
  for (std::size_t k = 0; k < segments.size(); ++k) {
    EnterMap(segments[k], poses[k], poses[k + 1], threads_, &map_);
  }
  const std::int64_t begin_ns = segments.front().begin_ns, end_ns = segments.back().end_ns;
  const ControlPose first = {begin_ns, poses.front(), flags};
  if (end_ns > begin_ns && !poses_.trajectory().empty()) {
    poses_.Append({first});
  } else if (end_ns > begin_ns && HasMap()) {
    poses_.Begin(first);
  }
  window_ = MakeWindow(end_ns, poses.back());
  window_.begin_flags = flags;
  window_.begin_velocity = velocity;
  support_.Begin(end_ns);
}

bool Tracker::HasMap() const { return was_held() || map_.finest().size() >= kFewestToBegin; }

std::optional<WindowStatistics> Tracker::Step(SegmentCloud* cloud, std::optional<Window>* solved) {
  const std::vector<SE3> predicted = Push(cloud);

  WindowStatistics statistics;
  statistics.restless = RestlessStep(window_.segments.back().cloud);
  estimator_.AssociateAndSolve(map_, &window_, &statistics);
  if (doubt_.IsContradicted(statistics.agreement)) {
    estimator_.Reassociate(map_, predicted, &motion_prior_, &window_, &statistics);
  }
  // Before the points ever held the body, there is no prediction to trust.
  if (was_held()) estimator_.LeaveOutUnsupported(predicted, &window_, &statistics);
  if (IsBlind()) {
    TakeBack(predicted, cloud);
    return std::nullopt;
  }
  statistics.correction = MeasureStep(predicted.back(), window_.EndPose());
  BelieveOrRevert(predicted, statistics);
  LearnAndJudge(predicted.back(), &statistics);
  Watch(&statistics);
  if (solved != nullptr) *solved = window_;
  if (doubt_.IsSure()) SmoothBack(&statistics);
  const int to_keep = SegmentsToKeep(window_.segments.back(), options_.window.segments);
  while (window_.size() > to_keep) Leave(&statistics);
  NoteLoss(&statistics);
  if (looks_around_) RelocalizeWindow(statistics.agreement);
  return statistics;
}

/// A segment comes, where the motion prior puts it. Returns the predicted poses.
std::vector<SE3> Tracker::Push(SegmentCloud* cloud) {
  const Vector6d velocity = motion_prior_.Predict(window_, cloud->Duration_s());
  PushSegment(std::move(*cloud), velocity, options_.window.deskewing, &window_);
  motion_prior_.Apply(&window_);
  Segment& newest = window_.segments.back();
  newest.noise_factor = motion_prior_.noise_factor();
  newest.bend_m2 = motion_prior_.Bend_m2(newest.cloud);
  if (window_.size() == 1) window_.noise = MakeRegistrationNoise(options_.registration);
  return window_.Poses();
}

/// Whether the points of the newest segment do not hold the body, and did not for too long.
bool Tracker::IsBlind() const {
  return IsUnsupported(window_, window_.segments.back()) &&
         support_.IsBlind(window_.EndNs(), motion_prior_.density());
}

/// As if the newest segment had not come: the others are estimated without it.
void Tracker::TakeBack(const std::vector<SE3>& predicted, SegmentCloud* cloud) {
  *cloud = std::move(window_.segments.back().cloud);
  window_.BeginAgainAt(predicted);
  window_.segments.pop_back();
  if (window_.size() == 0) return;
  WindowStatistics again;
  estimator_.AssociateAndSolve(map_, &window_, &again);
  estimator_.LeaveOutUnsupported(predicted, &window_, &again);
  if (!again.is_finite) Revert(predicted, &window_);
}

void Tracker::BelieveOrRevert(const std::vector<SE3>& predicted,
                              const WindowStatistics& statistics) {
  window_.is_believed = IsBelievable(statistics, window_);
  if (!window_.is_believed) {
    Revert(predicted, &window_);
    return;
  }
  NoteSupport();
  // Solved poses show how noisy the points are: a bad prediction is no noise.
  map_.SetScatter(std::min(PointScatter(window_), options_.registration.kernel_m));
}

/// The newest segment that its points hold. One that sees a new part of the world is held as soon
/// as the map has grown there. The first time, all must be: a LiDAR that sees a patch of the ground
/// has points enough now and then, and nowhere that it could be found again.
void Tracker::NoteSupport() {
  const std::vector<Segment>& segments = window_.segments;
  const auto is_held = [&](const Segment& segment) { return !IsUnsupported(window_, segment); };
  if (!was_held() && !std::all_of(segments.begin(), segments.end(), is_held)) return;
  const auto newest = std::find_if(segments.rbegin(), segments.rend(), is_held);
  if (newest != segments.rend()) support_.Supported(newest->cloud.end_ns);
}

/// Side by side: neither needs the other.
void Tracker::LearnAndJudge(const SE3& T_world_predicted, WindowStatistics* statistics) {
  SideTask learning(threads_);
  if (window_.is_believed) {
    learning.Start([&] {
      const Innovation innovation = MeasureInnovation(window_, T_world_predicted);
      const double duration_s = window_.segments.back().Duration_s();
      motion_prior_.Learn(innovation, duration_s);
      motion_prior_.LearnPersistence(innovation, window_.EndVelocity(), duration_s);
    });
  }
  Describe(window_, statistics);
  Judge(options_.registration, &window_, statistics);
  learning.Wait();
  statistics->translation_density_m2_s3 = motion_prior_.density()[0];
  statistics->rotation_density_rad2_s3 = motion_prior_.density()[3];
  statistics->velocity_persistence = motion_prior_.persistence().share();
  statistics->noise_factor = motion_prior_.noise_factor();
}

/// Judges the window by those before it as well.
void Tracker::Watch(WindowStatistics* statistics) {
  if (inlier_watch_.HasFew(*statistics)) statistics->flags |= kFlagFewInliers;
  const bool is_contradicted = window_.is_believed && lone_object_.IsContradicted(window_);
  // That nothing holds the direction says as much.
  if (is_contradicted && (statistics->flags & kFlagDegenerate) == 0) {
    statistics->flags |= kFlagLoneObject;
  }
  // These take time to show: they hold for all poses that are still here.
  const unsigned late = statistics->flags & (kFlagFewInliers | kFlagJump | kFlagLoneObject);
  poses_.FlagFirst(late);
  window_.begin_flags |= late;
  for (Segment& segment : window_.segments) segment.flags |= late;
  doubt_.Update(window_, *statistics, motion_prior_.density());
  statistics->flags |= doubt_.flags();
  Segment& newest = window_.segments.back();
  newest.flags = statistics->flags;
  // A LiDAR that is blind to one side, or sees the sky there, is carried on for a moment in every
  // turn: not long enough for a doubt.
  if (doubt_.flags() == 0 && SeesNothing(newest)) newest.flags &= ~kFlagNoPoints;
}

/// What left the window in doubt is estimated once more.
void Tracker::SmoothBack(WindowStatistics* statistics) {
  leaving_.SmoothBack(window_, [&](Window joined) -> std::optional<Window> {
    motion_prior_.Apply(&joined);
    const std::vector<SE3> start = joined.Poses();
    WindowStatistics rounds;
    estimator_.AssociateAndSolve(map_, &joined, &rounds);
    estimator_.LeaveOutUnsupported(start, &joined, &rounds);
    statistics->AddTimes(rounds);
    if (!rounds.is_finite) return std::nullopt;
    return joined;
  });
}

/// The oldest segment leaves: its first pose is settled, its points enter the map.
void Tracker::Leave(WindowStatistics* statistics) {
  Stopwatch watch;
  SettleFront();
  if (rig_ != nullptr) rig_->Learn(window_);
  const SE3 T_begin = window_.T_world_begin;
  const Segment& front = window_.segments.front();
  // What no plane agrees with may be a hand before the LiDAR; but the first points agree with
  // nothing.
  const bool is_of_the_world =
      !was_held() || (!IsUnsupported(window_, front) && doubt_.MayEnterMap(window_, front));
  Segment oldest = Marginalize(options_.marginalization, &window_);
  statistics->milliseconds_marginalize += watch.Milliseconds();
  if (is_of_the_world) EnterMap(oldest.cloud, T_begin, oldest.T_world_end, threads_, &map_);
  map_.RemoveFar(oldest.T_world_end.t);
  statistics->milliseconds_map += watch.Milliseconds();
  leaving_.AddSegment(std::move(oldest));
}

/// The pose at the front of the window leaves it. The trajectory begins where the map does: what
/// was before it, nothing tells.
void Tracker::SettleFront() {
  attitude_.Add(window_.T_world_begin.q);
  if (poses_.trajectory().empty() && !HasMap()) return;
  Matrix6d covariance = Matrix6d::Zero();
  if (poses_.has_callback()) {
    covariance = motion_prior_.covariance_scale() * PoseCovariance(AssembleWindow(window_), 0);
  }
  leaving_.Leave(window_, covariance, was_held() && !doubt_.IsSure());
}

/// A body that was never held has no place that it could lose.
void Tracker::NoteLoss(WindowStatistics* statistics) {
  if (!was_held()) return;
  if (const auto lost_since_ns = loss_watch_.Update(*statistics)) {
    statistics->flags |= kFlagLost;
    leaving_.Lose(*lost_since_ns);
  }
}

/// While the doubt lasts, the map does not grow, and a body at the right place would soon be out of
/// it. Where the window is clearly found, the body is.
void Tracker::RelocalizeWindow(double agreement) {
  const std::optional<SweepMotion> found =
      window_search_.Look(window_, doubt_, agreement, TurnAxis(), map_, threads_);
  if (!found) return;
  doubt_.Dispel(window_.EndNs());
  if (MeasureStep(window_.T_world_begin, found->T_world_begin).IsWithin(kSamePlace)) return;
  MoveWindow(*found, &window_);
  support_.Supported(window_.EndNs());
  loss_watch_ = LossWatch();
}

/// About which the body may have turned most while its points did not hold it. A body on a rope
/// turns about no vertical; but where only the floor was in view, its tilt is known.
Eigen::Vector3d Tracker::TurnAxis() const {
  return doubt_.open_axis_world().value_or(attitude_.VerticalInWorld());
}

void Tracker::EndWindow(std::int64_t before_ns) {
  WindowStatistics unused;
  while (window_.size() > 0) Leave(&unused);
  if (window_.begin_ns < before_ns) SettleFront();
}

void Tracker::End(std::int64_t before_ns) {
  EndWindow(before_ns);
  leaving_.Settle();
}

void Tracker::BeginBehindPause(std::int64_t end_ns) {
  EndWindow(end_ns);
  window_ = MakeWindow(end_ns, window_.T_world_begin);
  window_.begin_flags = kFlagGap;
  motion_prior_.NoteGap();
}

void Tracker::ForgetMap(std::int64_t end_ns) {
  map_ = MapPyramid(options_.map);
  poses_.ForgetFirst();
  window_ = MakeWindow(end_ns, SE3());
}

LastSeen Tracker::WhereLastSeen() const {
  const SE3& T_world_body = window_.EndPose();
  return {support_.supported_until_ns(),
          window_.EndNs(),
          T_world_body,
          attitude_.Levelled(T_world_body.q),
          window_.EndVelocity(),
          motion_prior_.density(),
          TurnAxis()};
}

void Tracker::Resume(const SegmentCloud& sweep, const SweepMotion& found) {
  EndWindow(sweep.begin_ns);
  if (sweep.is_instant) leaving_.Settle();
  leaving_.AddGap(sweep.begin_ns);
  const SE3& T_world_begin = found.T_world_begin;
  window_ = MakeWindow(sweep.begin_ns, T_world_begin);
  window_.prior = AnchorOfFound(T_world_begin);
  window_.begin_flags = kFlagGap;
  if (!sweep.is_instant) {
    window_.begin_velocity = found.tau / sweep.Duration_s();
  } else {
    // The mean velocity since the points held the body: all of that is settled by now.
    const std::int64_t seen_ns = support_.supported_until_ns();
    const SE3 T_world_seen = poses_.trajectory().At(seen_ns).value_or(T_world_begin);
    window_.begin_velocity = Minus(T_world_begin, T_world_seen) / Seconds(sweep.begin_ns - seen_ns);
    EnterMap(sweep, T_world_begin, T_world_begin, threads_, &map_);
  }
  support_.Supported(sweep.begin_ns);
  motion_prior_.NoteGap();
  doubt_.Dispel(sweep.begin_ns);
  loss_watch_ = LossWatch();
}

void Tracker::Lose(std::int64_t t_ns) {
  leaving_.Lose(support_.supported_until_ns() + 1);
  End(t_ns);
  map_ = MapPyramid(options_.map);
  // What was usual there says nothing here, and wrong windows taught wrong motions.
  motion_prior_ = MotionPrior(options_.motion_prior);
  inlier_watch_ = InlierWatch();
  lone_object_ = LoneObjectWatch();
  loss_watch_ = LossWatch();
  support_ = SupportWatch();
  doubt_ = DoubtWatch();
}

}  // namespace trajlo
