// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/odometry/health/doubt.h"
#include "core/odometry/health/inlier_watch.h"
#include "core/odometry/health/lone_object.h"
#include "core/odometry/health/loss_watch.h"
#include "core/odometry/health/support.h"
#include "core/odometry/leaving_poses.h"
#include "core/odometry/odometry_options.h"
#include "core/odometry/parallel/thread_pool.h"
#include "core/odometry/rig/rig_calibration.h"
#include "core/odometry/start/mean_attitude.h"
#include "core/odometry/start/return_search.h"
#include "core/odometry/start/window_search.h"
#include "core/odometry/window_estimator.h"

namespace trajlo {

/// Follows a body through a map that grows with it: one step for each segment. It is given a map to
/// begin with, and a new place where it loses the body.
class Tracker {
 public:
  /// `threads` must outlive it, and so must `rig`, which learns from every segment that leaves.
  Tracker(const OdometryOptions& options, const WindowSolverFactory& make_solver,
          ThreadPool* threads, RigCalibration* rig = nullptr);

  /// A body in doubt is not looked for elsewhere in the map: of many trackers that try something,
  /// the wrong ones may as well stay lost.
  void StayLost() { looks_around_ = false; }

  /// A map of the first segments alone, at `poses` in the world (one more), and a window that
  /// begins where they end, at `velocity` ([rho; theta] per second, body frame). The first and the
  /// last of the poses are of the trajectory, and have these flags: what may be wrong there shows
  /// in the windows that follow.
  void BeginMap(const std::vector<SegmentCloud>& segments, const std::vector<SE3>& poses,
                const Vector6d& velocity, unsigned flags);
  /// Whether there is something that points can agree with.
  bool HasMap() const;
  /// Whether the points ever held all segments of a window. Before, nothing is known that could be
  /// lost, or found again.
  bool was_held() const { return support_.was_supported(); }

  /// One step of the method: a segment comes, a window is estimated, the oldest segment leaves.
  /// Returns what happened; nothing where the points do not hold the body, and did not for so long
  /// that the motion prior does not tell where it is. Then `cloud` is given back, and all is as if
  /// it had not come. (Points that were moved by the prediction, see Deskewing, stay so.) `solved`
  /// gets the window as it was solved, before its oldest segment leaves, if that is asked for.
  std::optional<WindowStatistics> Step(SegmentCloud* cloud,
                                       std::optional<Window>* solved = nullptr);

  /// All poses of the window before `before_ns` leave, its segments enter the map, and nothing
  /// waits any more.
  void End(std::int64_t before_ns);

  /// Begins again behind a pause which ends at `end_ns`, at the same pose, before points were held:
  /// what was seen before tells neither where the body is behind it nor how it moved.
  void BeginBehindPause(std::int64_t end_ns);
  /// The same, where the map is all that there was: it is forgotten.
  void ForgetMap(std::int64_t end_ns);

  /// What is known of the body, for a search.
  LastSeen WhereLastSeen() const;
  /// Goes on where a sweep was found in the map.
  void Resume(const SegmentCloud& sweep, const SweepMotion& found);
  /// Forgets the map, in which the body could not be found again. What comes from `t_ns` on is a
  /// recording by itself.
  void Lose(std::int64_t t_ns);

  const SE3& T_world_begin() const { return window_.T_world_begin; }
  const MapPyramid& map() const { return map_; }
  const FinalPoses& poses() const { return poses_; }
  FinalPoses& poses() { return poses_; }
  /// When the body was lost for the first time, if it was.
  const std::optional<std::int64_t>& lost_at_ns() const { return leaving_.lost_at_ns(); }

 private:
  std::vector<SE3> Push(SegmentCloud* cloud);
  bool IsBlind() const;
  void TakeBack(const std::vector<SE3>& predicted, SegmentCloud* cloud);
  void BelieveOrRevert(const std::vector<SE3>& predicted, const WindowStatistics& statistics);
  void NoteSupport();
  void LearnAndJudge(const SE3& T_world_predicted, WindowStatistics* statistics);
  void Watch(WindowStatistics* statistics);
  void SmoothBack(WindowStatistics* statistics);
  void EndWindow(std::int64_t before_ns);
  void Leave(WindowStatistics* statistics);
  void SettleFront();
  void NoteLoss(WindowStatistics* statistics);
  void RelocalizeWindow(double agreement);
  Eigen::Vector3d TurnAxis() const;

  const OdometryOptions options_;
  ThreadPool* threads_;
  RigCalibration* rig_;
  MapPyramid map_;
  Window window_;
  MotionPrior motion_prior_;
  WindowEstimator estimator_;
  InlierWatch inlier_watch_;
  LoneObjectWatch lone_object_;
  LossWatch loss_watch_;
  SupportWatch support_;
  DoubtWatch doubt_;
  WindowSearch window_search_;
  bool looks_around_ = true;
  MeanAttitude attitude_;
  FinalPoses poses_;
  LeavingPoses leaving_;
};

}  // namespace trajlo
