// SPDX-License-Identifier: MIT
#include "core/odometry/odometry.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/odometry/health/belief.h"
#include "core/odometry/parallel/side_task.h"
#include "core/odometry/window/covariance.h"
#include "core/odometry/window/enter_map.h"
#include "core/odometry/window/point_scatter.h"
#include "core/odometry/window/push_segment.h"
#include "core/timing/stopwatch.h"

namespace trajlo {
namespace {

/// The window keeps so few segments where fewer of the newest points than this share have a plane.
constexpr int kShortWindow = 2;
constexpr double kSeesMap = 0.5;

}  // namespace

Odometry::Odometry(const OdometryOptions& options, const WindowSolverFactory& make_solver)
    : options_(options),
      threads_(options.threads),
      segments_(options.segmenter, &threads_,
                [this](SegmentCloud segment) {
                  rig_.Apply(&segment);
                  Take(std::move(segment));
                  poses_.HandOn();
                }),
      rig_(options.segmenter.learn_rig),
      map_(options.map),
      motion_prior_(options.motion_prior),
      estimator_(options.registration, options.solver, make_solver, &threads_) {}

void Odometry::AddScan(const LidarScan& scan) { segments_.Add(scan); }

void Odometry::Finish() {
  segments_.Finish();
  if (beginning_) Start();
  if (search_ && search_->HasPoints()) Search(true);
  if (beginning_) Start();
  SettleWindow(std::numeric_limits<std::int64_t>::max());
  SettleStretch();
  poses_.HandOn();
}

void Odometry::Take(SegmentCloud cloud) {
  if (beginning_) {
    TakeFirst(std::move(cloud));
    return;
  }
  if (cloud.is_gap && !support_.was_supported() && !search_) {
    if (!trajectory().empty()) {
      SettleWindow(cloud.end_ns);
      window_ = MakeWindow(cloud.end_ns, window_.T_world_begin);
      window_.begin_flags = kFlagGap;
      return;
    }
    Forget(cloud.end_ns);
  }
  if ((cloud.is_gap || !HasMap()) && !search_) BeginSearch();
  if (!search_) {
    Step(std::move(cloud));
    return;
  }
  search_->Add(std::move(cloud));
  if (search_->IsDue()) Search(false);
}

/// One step of the method: a segment comes, a window is estimated, the oldest segment leaves.
void Odometry::Step(SegmentCloud cloud) {
  PushSegment(std::move(cloud), options_.window.deskewing, &window_);
  motion_prior_.Apply(&window_);
  window_.segments.back().bend_m2 = motion_prior_.Bend_m2(window_.segments.back().cloud);
  if (window_.size() == 1) window_.noise = MakeRegistrationNoise(options_.registration);
  const std::vector<SE3> predicted = window_.Poses();

  WindowStatistics statistics;
  statistics.restless = RestlessStep(window_.segments.back().cloud);
  estimator_.AssociateAndSolve(map_, &window_, &statistics);
  if (doubt_.IsContradicted(statistics.agreement)) LookAgain(predicted, &statistics);
  // Before the points ever held the body, there is no prediction to trust.
  if (support_.was_supported()) {
    estimator_.LeaveOutUnsupported(predicted, &window_, &statistics);
  }
  statistics.correction = MeasureStep(predicted.back(), window_.EndPose());
  if (IsBlind()) {
    TakeBackAndSearch(predicted);
    return;
  }
  BelieveOrRevert(predicted, statistics);
  LearnAndJudge(predicted.back(), &statistics);
  Watch(&statistics);
  if (doubt_.IsSure() && !hindsight_.is_empty()) LookBack(&statistics);
  const int to_keep = SegmentsToKeep();
  while (window_.size() > to_keep) Leave(&statistics);
  Report(&statistics);
  LookAround(statistics.agreement);
}

void Odometry::BelieveOrRevert(const std::vector<SE3>& predicted,
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

/// Side by side: neither needs the other.
void Odometry::LearnAndJudge(const SE3& T_world_predicted, WindowStatistics* statistics) {
  SideTask learning(&threads_);
  if (window_.is_believed) {
    learning.Start([&] {
      motion_prior_.Learn(MeasureInnovation(window_, T_world_predicted),
                          window_.segments.back().Duration_s());
    });
  }
  Describe(window_, statistics);
  Judge(options_.registration, &window_, statistics);
  learning.Wait();
}

/// Judges the window by those before it as well.
void Odometry::Watch(WindowStatistics* statistics) {
  if (inlier_watch_.HasFew(*statistics)) statistics->flags |= kFlagFewInliers;
  // These take time to show: they hold for all poses that are still here.
  const unsigned late = statistics->flags & (kFlagFewInliers | kFlagJump);
  poses_.FlagFirst(late);
  window_.begin_flags |= late;
  for (Segment& segment : window_.segments) segment.flags |= late;
  doubt_.Update(window_, *statistics, motion_prior_.density());
  statistics->flags |= doubt_.flags();
  window_.segments.back().flags = statistics->flags;
}

/// What no plane agrees with may be a hand before the LiDAR.
bool Odometry::MayEnterMap(const Segment& segment) const {
  return !IsUnsupported(window_, segment) && doubt_.MayEnterMap(window_, segment);
}

/// Points enter the map when they leave the window. In a fast turn that comes too late: the newest
/// ones see what only the window has seen. Then the window is shorter, and the map grows with them.
int Odometry::SegmentsToKeep() const {
  const Segment& newest = window_.segments.back();
  const auto all = static_cast<double>(newest.cloud.registration_points.size());
  const bool sees_map = static_cast<double>(newest.points.size()) >= kSeesMap * all;
  return sees_map ? options_.window.segments - 1
                  : std::min(kShortWindow, options_.window.segments - 1);
}

/// The oldest segment leaves: its first pose is settled, its points enter the map.
void Odometry::Leave(WindowStatistics* statistics) {
  Stopwatch watch;
  SettleFront();
  rig_.Learn(window_);
  segments_.CorrectClocks(rig_.Clocks_s());
  const SE3 T_begin = window_.T_world_begin;
  // The first points agree with nothing.
  const bool is_of_the_world = !support_.was_supported() || MayEnterMap(window_.segments.front());
  Segment oldest = Marginalize(options_.marginalization, &window_);
  statistics->milliseconds_marginalize += watch.Milliseconds();
  if (is_of_the_world) {
    EnterMap(oldest.cloud, T_begin, oldest.T_world_end, &threads_, &map_);
  }
  map_.RemoveFar(oldest.T_world_end.t);
  statistics->milliseconds_map += watch.Milliseconds();
  if (!hindsight_.is_empty()) hindsight_.AddSegment(std::move(oldest));
}

void Odometry::Report(WindowStatistics* statistics) {
  statistics->index = windows_++;
  statistics->milliseconds_segment = segments_.TakeMilliseconds();
  statistics->translation_density_m2_s3 = motion_prior_.density()[0];
  statistics->rotation_density_rad2_s3 = motion_prior_.density()[3];
  if (const auto lost_since_ns = loss_watch_.Update(*statistics)) {
    statistics->flags |= kFlagLost;
    if (!lost_at_ns_) lost_at_ns_ = lost_since_ns;
  }
  if (on_window_) on_window_(*statistics);
}

/// All poses of the window that lie before `before_ns` are final.
void Odometry::SettleWindow(std::int64_t before_ns) {
  WindowStatistics unused;
  while (window_.size() > 0) Leave(&unused);
  if (window_.begin_ns < before_ns) SettleFront();
}

/// The pose at the front of the window leaves it.
void Odometry::SettleFront() {
  const Matrix6d covariance = poses_.has_callback() ? PoseCovariance(AssembleWindow(window_), 0)
                                                    : Matrix6d(Matrix6d::Zero());
  const bool is_lost = lost_at_ns_ && window_.begin_ns >= *lost_at_ns_;
  const unsigned flags = window_.begin_flags | (is_lost ? kFlagLost : 0U);
  const LeavingPose leaving = {{window_.begin_ns, window_.T_world_begin, flags}, covariance};
  attitude_.Add(window_.T_world_begin.q);
  if (MustWait()) {
    Wait(leaving);
  } else {
    Settle(leaving);
  }
}

/// The trajectory begins where the map does: what was before it, nothing tells.
void Odometry::Settle(const LeavingPose& leaving) {
  const bool is_first = trajectory().empty();
  if (is_first && !HasMap()) return;
  poses_.Append({leaving.pose, motion_prior_.covariance_scale() * leaving.covariance});
  if (is_first) segments_.NoteFirstPose(trajectory().poses().front().t_ns);
}

}  // namespace trajlo
