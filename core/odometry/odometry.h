// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>

#include "core/odometry/map/map_pyramid.h"
#include "core/odometry/sensing/segmenter.h"
#include "core/odometry/sensing/time_report.h"
#include "core/odometry/solvers/solver_options.h"
#include "core/odometry/solvers/window_solver.h"
#include "core/odometry/trajectory/trajectory.h"
#include "core/odometry/weights/adaptive_threshold.h"
#include "core/odometry/weights/weight_balance.h"
#include "core/odometry/window/association.h"
#include "core/odometry/window/deskew.h"
#include "core/odometry/window/loss_watch.h"
#include "core/odometry/window/segment_interval.h"
#include "core/odometry/window/window_statistics.h"

namespace trajlo {

struct WindowOptions {
  /// The paper's K: segments that are estimated together.
  int segments = 4;
  /// `predicted` is for comparison: discrete poses, deskewed by constant velocity, as in KISS-ICP.
  /// The first interval is moved by its own estimate in either case.
  Deskewing deskewing = Deskewing::kEstimated;
};

struct InitializationOptions {
  /// Estimates the motion during the first interval by registering its second half to its first
  /// one; otherwise a stationary start is assumed, as in the paper.
  bool estimate_motion = true;
  /// The estimated motion is believed only if it brings this many times as many points onto planes
  /// as standing still does ...
  double min_gain = 1.15;
  /// ... or simply more, where it is longer than this: at rest the estimate is off by centimetres,
  /// and a street explains nearly as many points at any speed.
  double clear_motion_m = 0.3;
};

/// Everything that the estimator can be told, by module.
struct OdometryOptions {
  SegmenterOptions segmenter;
  AdaptiveIntervalOptions adaptive_interval;
  MapPyramidOptions map;
  AssociationOptions association;
  AdaptiveThresholdOptions threshold;
  WeightOptions weights;
  WeightBalanceOptions weight_balance;
  SolverOptions solver;
  MarginalizationOptions marginalization;
  WindowOptions window;
  InitializationOptions initialization;
  LostOptions lost;
  /// Multiplies the covariances that are handed out: the window takes the map for exact and the
  /// errors of its points for independent. 1 hands out what the information says.
  double covariance_scale = 1.0;
  /// 0 takes all cores. No result depends on it.
  int threads = 0;
};

/// LiDAR odometry: scans go in, a continuous-time trajectory and a map come out.
///
///   Odometry odometry(options);
///   while (reader.Next(&scan)) odometry.AddScan(scan);
///   odometry.Finish();
///   odometry.trajectory().At(t_ns);
///
/// The world frame is the body frame at the first point.
class Odometry {
 public:
  explicit Odometry(const OdometryOptions& options,
                    const WindowSolverFactory& make_solver = MakeWindowSolver);
  ~Odometry();

  /// Takes a scan as it was recorded, whatever its stamp (see ScanSequencer), and processes every
  /// window that it completes.
  void AddScan(const LidarScan& scan);
  /// Processes what is left and settles all control poses.
  void Finish();

  /// Called with every scan that is used, in order, its times as they are understood.
  void OnScan(std::function<void(const LidarScan&)> callback);

  /// Called after every window.
  void OnWindow(std::function<void(const WindowStatistics&)> callback);

  /// Called for every control pose when it leaves the window, with the covariance of its right
  /// perturbation [rho; theta] (m², m rad, rad²) by the information of its last window, times
  /// `covariance_scale`. Computed only if this is set.
  void OnPose(std::function<void(const ControlPose&, const Matrix6d& covariance)> callback);

  /// The control poses that have left the window (all of them after Finish).
  const Trajectory& trajectory() const;
  const MapPyramid& map() const;
  PointCounts point_counts() const;
  /// What became of scans with odd stamps.
  const TimeReport& time_report() const;
  /// When the estimator got lost, if it did (sticky).
  std::optional<std::int64_t> lost_at_ns() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trajlo
