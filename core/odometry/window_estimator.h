// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "core/odometry/health/window_statistics.h"
#include "core/odometry/map/map_pyramid.h"
#include "core/odometry/parallel/thread_pool.h"
#include "core/odometry/solvers/window_solver.h"
#include "core/odometry/weights/motion_prior.h"
#include "core/odometry/weights/registration_options.h"
#include "core/odometry/window/window.h"

namespace trajlo {

/// Finds the poses of a window: associate and solve in turn, until the step is small.
class WindowEstimator {
 public:
  /// `threads` must outlive it.
  WindowEstimator(const RegistrationOptions& registration, const SolverOptions& options,
                  const WindowSolverFactory& make_solver, ThreadPool* threads)
      : registration_(registration),
        options_(options),
        threads_(threads),
        solver_(make_solver(options, threads)) {}

  /// From the window's poses on: which planes of the map the points belong to, and the poses that
  /// bring them there.
  void AssociateAndSolve(const MapPyramid& map, Window* window, WindowStatistics* statistics);

  /// The points contradict the map where the motion prior led them: the body began to turn as the
  /// prior did not foresee. (By some degrees within a segment; no body is flung so far aside.) They
  /// look again from the prediction, while its attitude may be anything near. If they agree better
  /// then, and hold it, the prior follows; else all stays as it was. (A hand before the LiDAR has
  /// few points, which agree with whatever is near.)
  void Reassociate(const MapPyramid& map, const std::vector<SE3>& predicted,
                   MotionPrior* motion_prior, Window* window, WindowStatistics* statistics);

  /// Solves again without the points that do not hold their segments, from the prediction: what is
  /// left agrees with it. Does nothing if all segments are held.
  void LeaveOutUnsupported(const std::vector<SE3>& predicted, Window* window,
                           WindowStatistics* statistics);

 private:
  const RegistrationOptions registration_;
  const SolverOptions options_;
  ThreadPool* threads_;
  std::unique_ptr<WindowSolver> solver_;
};

}  // namespace trajlo
