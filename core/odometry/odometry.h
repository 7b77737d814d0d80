// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "core/odometry/health/window_statistics.h"
#include "core/odometry/odometry_options.h"
#include "core/odometry/parallel/thread_pool.h"
#include "core/odometry/rig/rig_calibration.h"
#include "core/odometry/segments/segment_stream.h"
#include "core/odometry/solvers/window_solver.h"
#include "core/odometry/start/beginning.h"
#include "core/odometry/start/return_search.h"
#include "core/odometry/tracker.h"

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
  /// Throws std::invalid_argument for options that are out of range or contradict each other: see
  /// CheckOptions.
  explicit Odometry(const OdometryOptions& options,
                    const WindowSolverFactory& make_solver = MakeWindowSolver);
  Odometry(const Odometry&) = delete;
  Odometry& operator=(const Odometry&) = delete;

  /// Takes a scan as it was recorded, whatever its stamp (see ScanSequencer), and processes every
  /// window that it completes.
  void AddScan(const LidarScan& scan);
  /// Processes what is left and settles all control poses. If a callback throws, a second call goes
  /// on with what was not handed on.
  void Finish();

  /// Called with every scan that is used, in order, its times as they are understood. If there are
  /// several threads it may run on another one, while the windows that the scan completes are
  /// estimated and the other callbacks are called: it must share nothing with them, and ask this
  /// object nothing.
  void OnScan(std::function<void(const LidarScan&)> callback) {
    segments_.OnScan(std::move(callback));
  }

  /// Called for every window, once the segment that completed it is taken, on the thread that
  /// called AddScan or Finish.
  void OnWindow(std::function<void(const WindowStatistics&)> callback) {
    on_window_ = std::move(callback);
  }
  /// Called after that with the windows whose index `wants` takes: all factors, as they were
  /// solved, before the oldest segment leaves. See core/graph. Copying a window takes about a
  /// millisecond.
  void OnSolvedWindow(std::function<bool(std::int64_t index)> wants,
                      std::function<void(std::int64_t index, const Window&)> callback) {
    wants_solved_ = std::move(wants);
    on_solved_ = std::move(callback);
  }
  /// Called likewise for every control pose when it is final, with the covariance of its right
  /// perturbation [rho; theta] (m², m rad, rad²): that of the pose relative to the map in view, by
  /// its last window, calibrated. A pose is final when it leaves the window, or up to 5 s later if
  /// it is in doubt where the body is. What the map has drifted since the start is not in it.
  /// Computed only if this is set.
  void OnPose(std::function<void(const ControlPose&, const Matrix6d& covariance)> callback) {
    tracker_.poses().OnPose(std::move(callback));
  }

  /// The control poses that are final (all of them after Finish).
  const Trajectory& trajectory() const { return tracker_.poses().trajectory(); }
  const MapPyramid& map() const { return tracker_.map(); }
  const RigCalibration& rig() const { return rig_; }
  PointCounts point_counts() const { return segments_.point_counts(); }
  /// What became of scans with odd stamps.
  const TimeReport& time_report() const { return segments_.time_report(); }
  /// When the estimator got lost, if it did (sticky).
  std::optional<std::int64_t> lost_at_ns() const { return tracker_.lost_at_ns(); }

 private:
  /// What a callback is called for.
  struct NewWindow {
    WindowStatistics statistics;
    std::optional<Window> solved;
  };

  void Take(SegmentCloud cloud);
  void TellAhead();
  void HandOn();
  // A map is to begin.
  void Begin(Beginning beginning);
  void TakeFirst(SegmentCloud cloud);
  void Start();
  void FindFirstMotion(Beginning* beginning);
  void BeginMap(Beginning beginning);
  void BeginInMotion(const std::vector<SegmentCloud>& segments, std::size_t in_map,
                     const Vector6d& velocity, const SE3& T_begin, unsigned flags);
  // The body is followed.
  void Step(SegmentCloud cloud);
  // Nobody knows where it is.
  void BeginSearch();
  void Search(bool is_last);
  void Resume(const ReturnSweep& sweep);
  void BeginAgain(const ReturnSweep& sweep);
  void GetLost(const ReturnSweep& sweep);

  const OdometryOptions options_;
  const WindowSolverFactory make_solver_;
  ThreadPool threads_;
  SegmentStream segments_;
  RigCalibration rig_;
  Tracker tracker_;
  std::optional<Beginning> beginning_ = Beginning{};  ///< Until a map begins.
  std::optional<ReturnSearch> search_;                ///< While nobody knows where the body is.
  bool is_finishing_ = false, is_finished_ = false;
  std::function<void(const WindowStatistics&)> on_window_;
  std::function<bool(std::int64_t)> wants_solved_;
  std::function<void(std::int64_t, const Window&)> on_solved_;
  std::deque<NewWindow> windows_to_hand_on_;
  std::int64_t windows_ = 0;
};

}  // namespace trajlo
