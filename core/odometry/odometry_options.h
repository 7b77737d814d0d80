// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/map/map_pyramid.h"
#include "core/odometry/segments/segmenter.h"
#include "core/odometry/solvers/solver_options.h"
#include "core/odometry/start/initialization_options.h"
#include "core/odometry/weights/motion_prior.h"
#include "core/odometry/weights/registration_options.h"
#include "core/odometry/window/deskew.h"
#include "core/odometry/window/marginalize.h"
#include "core/options/describe.h"

namespace trajlo {

struct WindowOptions {
  int segments = 5;
  Deskewing deskewing = Deskewing::kEstimated;

  template <typename Describer>
  void Describe(Describer& d) {
    d(OptionFor::kUsers, "segments", segments, Range<int>{1, 100},
      "The largest number of segments in the window, the paper's K (paper: 4). While a fast turn "
      "shows little of the map, there are fewer.");
    d(OptionFor::kExperts, "deskewing", deskewing,
      Names<Deskewing>{{"estimated", Deskewing::kEstimated}, {"predicted", Deskewing::kPredicted}},
      "What moves the points of a segment to one time: the estimated trajectory, again in every "
      "iteration, or once the predicted motion (discrete poses and constant velocity as in "
      "KISS-ICP, for comparison).");
  }
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
  int threads = 0;

  template <typename Describer>
  void Describe(Describer& d) {
    d(OptionFor::kUsers, "threads", threads, Range<int>{0, 1024},
      "Number of threads; 0 takes all cores. The result does not depend on it. With N > 1, one "
      "more reads ahead, and as many decompress bz2 chunks of a ROS 1 bag.");
  }

  /// All of them, by section; `d.In(section)` says where those that follow belong.
  template <typename Describer>
  void DescribeAll(Describer& d) {
    segmenter.DescribeSensor(d.In("sensor"));
    segmenter.Describe(d.In("segmenter"));
    map.Describe(d.In("map"));
    map.plane.Describe(d.In("map.plane"));
    registration.Describe(d.In("registration"));
    motion_prior.Describe(d.In("motion_prior"));
    solver.Describe(d.In("solver"));
    marginalization.Describe(d.In("marginalization"));
    window.Describe(d.In("window"));
    initialization.Describe(d.In("initialization"));
    Describe(d.In(""));
  }
};

}  // namespace trajlo
