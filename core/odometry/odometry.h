// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "core/odometry/health/doubt.h"
#include "core/odometry/health/inlier_watch.h"
#include "core/odometry/health/loss_watch.h"
#include "core/odometry/health/support.h"
#include "core/odometry/health/window_statistics.h"
#include "core/odometry/odometry_options.h"
#include "core/odometry/parallel/thread_pool.h"
#include "core/odometry/rig/rig_calibration.h"
#include "core/odometry/segments/segment_stream.h"
#include "core/odometry/solvers/window_solver.h"
#include "core/odometry/start/beginning.h"
#include "core/odometry/start/return_search.h"
#include "core/odometry/trajectory/final_poses.h"
#include "core/odometry/window/hindsight.h"
#include "core/odometry/window/window.h"
#include "core/odometry/window_estimator.h"

namespace trajlo {

/// LiDAR odometry: scans go in, a continuous-time trajectory and a map come out.
///
///   Odometry odometry(options);
///   while (reader.Next(&scan)) odometry.AddScan(scan);
///   odometry.Finish();
///   odometry.trajectory().At(t_ns);
///
/// The world frame is the body frame at the first pose of the trajectory.
class Odometry {
 public:
  explicit Odometry(const OdometryOptions& options,
                    const WindowSolverFactory& make_solver = MakeWindowSolver);
  Odometry(const Odometry&) = delete;
  Odometry& operator=(const Odometry&) = delete;

  /// Takes a scan as it was recorded, whatever its stamp (see ScanSequencer), and processes every
  /// window that it completes.
  void AddScan(const LidarScan& scan);
  /// Processes what is left and settles all control poses.
  void Finish();

  /// Called with every scan that is used, in order, its times as they are understood. If there are
  /// several threads it may run on another one, while the windows that the scan completes are
  /// estimated and the other callbacks are called: it must share nothing with them, and ask this
  /// object nothing.
  void OnScan(std::function<void(const LidarScan&)> callback) {
    segments_.OnScan(std::move(callback));
  }

  /// Called after every window, on the thread that called AddScan or Finish.
  void OnWindow(std::function<void(const WindowStatistics&)> callback) {
    on_window_ = std::move(callback);
  }
  /// Called likewise for every control pose when it is final, with the covariance of its right
  /// perturbation [rho; theta] (m², m rad, rad²): that of the pose relative to the map in view, by
  /// its last window, calibrated. A pose is final when it leaves the window, or up to 5 s later if
  /// it is in doubt where the body is. What the map has drifted since the start is not in it.
  /// Computed only if this is set.
  void OnPose(std::function<void(const ControlPose&, const Matrix6d& covariance)> callback) {
    poses_.OnPose(std::move(callback));
  }

  /// The control poses that are final (all of them after Finish).
  const Trajectory& trajectory() const { return poses_.trajectory(); }
  const MapPyramid& map() const { return map_; }
  const RigCalibration& rig() const { return rig_; }
  PointCounts point_counts() const { return segments_.point_counts(); }
  /// What became of scans with odd stamps.
  const TimeReport& time_report() const { return segments_.time_report(); }
  /// When the estimator got lost, if it did (sticky).
  std::optional<std::int64_t> lost_at_ns() const { return lost_at_ns_; }

 private:
  void Begin(Beginning beginning);
  void TakeFirst(SegmentCloud cloud);
  void Start();
  void BeginMap(const SegmentCloud& cloud, const SE3& T_begin, const Vector6d& velocity,
                unsigned flags);
  void Forget(std::int64_t until_ns);
  void Take(SegmentCloud cloud);
  void Step(SegmentCloud cloud);
  void BeginSearch();
  void Search(bool is_last);
  void Resume(const ReturnSweep& sweep);
  void GetLost(const ReturnSweep& sweep);
  void BeginAgain(const ReturnSweep& sweep);
  bool HasMap() const;
  bool IsBlind() const;
  void TakeBackAndSearch(const std::vector<SE3>& predicted);
  void NoteSupport();
  void LookAgain(const std::vector<SE3>& predicted, WindowStatistics* statistics);
  Eigen::Vector3d TurnAxis() const;
  void LookAround(double agreement);
  void MoveWindow(const SweepMotion& found);
  void BelieveOrRevert(const std::vector<SE3>& predicted, const WindowStatistics& statistics);
  void LearnAndJudge(const SE3& T_world_predicted, WindowStatistics* statistics);
  void Watch(WindowStatistics* statistics);
  bool MayEnterMap(const Segment& segment) const;
  int SegmentsToKeep() const;
  void Leave(WindowStatistics* statistics);
  void Report(WindowStatistics* statistics);
  void SettleWindow(std::int64_t before_ns);
  void SettleFront();
  bool MustWait() const;
  void Wait(const LeavingPose& leaving);
  void LookBack(WindowStatistics* statistics);
  std::optional<Window> Reestimate(Window joined, WindowStatistics* statistics);
  void SettleStretch();
  void Settle(const LeavingPose& leaving);

  const OdometryOptions options_;
  ThreadPool threads_;
  SegmentStream segments_;
  RigCalibration rig_;
  MapPyramid map_;
  MotionPrior motion_prior_;
  WindowEstimator estimator_;
  InlierWatch inlier_watch_;
  LossWatch loss_watch_;
  SupportWatch support_;
  DoubtWatch doubt_;
  MeanAttitude attitude_;
  std::optional<ReturnSearch> search_;  ///< While nobody knows where the body is.
  Window window_;
  Hindsight hindsight_;  ///< While it is in doubt where the body is.
  FinalPoses poses_;
  std::function<void(const WindowStatistics&)> on_window_;
  std::optional<std::int64_t> lost_at_ns_;
  std::optional<Beginning> beginning_ = Beginning{};  ///< Until a map begins.
  /// LookAround() waits for a window that begins then.
  std::int64_t next_look_ns_ = std::numeric_limits<std::int64_t>::min();
  std::int64_t windows_ = 0;
};

}  // namespace trajlo
