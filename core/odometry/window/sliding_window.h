// SPDX-License-Identifier: MIT
#pragma once

#include <deque>

#include "core/odometry/odometry.h"
#include "core/odometry/solvers/window_solver.h"
#include "core/odometry/weights/weight_balance.h"
#include "core/odometry/window/association.h"

namespace trajlo {

/// The K newest segments and their K+1 control poses: predicts a new pose, alternates association
/// and solve until the steps are small, and hands out what leaves with its information kept as a
/// prior.
class SlidingWindow {
 public:
  /// `map` and `threads` must outlive the window.
  SlidingWindow(const OdometryOptions& options, const MapPyramid* map, ThreadPool* threads,
                const WindowSolverFactory& make_solver);

  /// Begins with a single control pose, held by the anchor, moving at `velocity` ([rho; theta] per
  /// second, body frame).
  void Start(std::int64_t t_ns, const SE3& T_world_body, const Vector6d& velocity);

  /// Adds a segment that begins where the window ends, and estimates.
  WindowStatistics AddSegment(SegmentCloud cloud);

  struct Left {
    SegmentCloud cloud;
    SE3 T_begin, T_end;
  };
  /// Folds the oldest control pose into the prior of the next and removes its segment.
  Left Marginalize();

  /// Of the oldest control pose, at the solution; see FirstPoseCovariance().
  Matrix6d front_covariance() const;

  int segments() const { return static_cast<int>(segments_.size()); }
  ControlPose front_pose() const;
  /// What holds the front pose.
  const MarginalizationPrior& prior() const { return problem_.prior; }
  /// All of them, oldest first.
  std::vector<ControlPose> poses() const;

 private:
  struct Segment {
    SegmentCloud cloud;
    SegmentAssociation association;
    unsigned flags = 0;
    double Duration_s() const { return static_cast<double>(cloud.end_ns - cloud.begin_ns) * 1e-9; }
  };

  void Predict();
  SegmentAssociation::Counts AssociateAll(bool renew);
  void BuildProblem();
  double KernelWidth() const;

  const OdometryOptions& options_;
  const MapPyramid* map_;
  ThreadPool* threads_;
  std::unique_ptr<WindowSolver> solver_;
  RegistrationEvaluator evaluator_;
  AdaptiveThreshold threshold_;
  WeightBalance balance_;
  std::deque<Segment> segments_;
  std::vector<Vector6d> expected_velocity_;      ///< Pseudo-velocity of each segment, per second.
  Vector6d velocity_before_ = Vector6d::Zero();  ///< Of the segment before the window.
  std::int64_t front_ns_ = 0;
  unsigned front_flags_ = 0;
  bool is_reverted_ = false;  ///< The last solve was not believed.
  WindowProblem problem_;     ///< Holds the poses and the prior between solves.
  std::vector<RegistrationNormalEquations> registration_;  ///< At the poses of problem_.
};

}  // namespace trajlo
