// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/health/loss_watch.h"
#include "core/odometry/map/map_pyramid.h"
#include "core/odometry/sensing/segmenter.h"
#include "core/odometry/solvers/solver_options.h"
#include "core/odometry/start/initial_motion.h"
#include "core/odometry/weights/motion_prior.h"
#include "core/odometry/weights/registration_options.h"
#include "core/odometry/window/deskew.h"
#include "core/odometry/window/marginalize.h"

namespace trajlo {

struct WindowOptions {
  /// The paper's K: segments that are estimated together.
  int segments = 4;
  /// `predicted` is for comparison: discrete poses, deskewed by constant velocity, as in KISS-ICP.
  /// The first interval is moved by its own estimate in either case.
  Deskewing deskewing = Deskewing::kEstimated;
};

/// Everything that the estimator can be told, by module.
struct OdometryOptions {
  SegmenterOptions segmenter;
  InitializationOptions initialization;
  MapPyramidOptions map;
  RegistrationOptions registration;
  MotionPriorOptions motion_prior;
  WindowOptions window;
  SolverOptions solver;
  MarginalizationOptions marginalization;
  LostOptions lost;
  /// Multiplies the covariances that are handed out.
  double covariance_scale = 1.0;
  /// 0 takes all cores. No result depends on it.
  int threads = 0;
};

}  // namespace trajlo
