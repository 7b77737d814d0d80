// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/odometry/map/map_pyramid.h"
#include "core/odometry/parallel/thread_pool.h"
#include "core/odometry/segments/segment_cloud.h"
#include "core/odometry/weights/registration_options.h"
#include "core/options/describe.h"

namespace trajlo {

/// What the points of the second half say of a motion over the interval.
struct MotionEvidence {
  int agreeing = 0;    ///< How many lie on planes of the first half, ...
  int with_plane = 0;  ///< ... and how many have one.
  /// See MotionHypothesis::VotesAlong: of planes that face the direction which is held weakly, if
  /// one is. Of the others, many agree with any motion along it.
  int votes = 0;
};

struct InitialMotion {
  /// The body's twist over the whole first interval: T(alpha) = Exp(alpha tau).
  Vector6d tau = Vector6d::Zero();
  int points = 0;          ///< Of the second half.
  MotionEvidence found;    ///< For tau.
  MotionEvidence at_rest;  ///< For a sensor that stood still.
  /// The direction of translation in the frame of the first pose that hardly any point holds, if
  /// there is one; none where the few that tell say that the body is at rest.
  std::optional<Eigen::Vector3d> open_direction;
};

/// Finds how the sensor moved during the first interval from nothing but the interval itself: the
/// points of its second half, each at its own time on Exp(alpha tau), are registered to those of
/// its first half, which move with the same tau. A wrong tau blurs the first half by a third of
/// what it displaces the second, so each round leaves about a third of the error. The voxels start
/// coarse and shrink. Where one direction is held weakly, the search is started at many speeds
/// along it: on a motorway the ground agrees with all of them.
InitialMotion EstimateInitialMotion(const SegmentCloud& cloud, const MapPyramidOptions& map_options,
                                    const RegistrationOptions& registration, ThreadPool* threads);

struct InitializationOptions {
  double first_interval_s = 0.3;
  bool estimate_motion = true;

  template <typename Describer>
  void Describe(Describer& d) {
    d(OptionFor::kExperts, "first_interval_s", first_interval_s, Range<double>{1e-3, 10.0},
      "The motion at the start is estimated from this much of the recording, which also fills the "
      "map where it moves steadily (paper: 0.3 s).");
    d(OptionFor::kExperts, "estimate_motion", estimate_motion,
      "Estimates the motion during the first interval by registering its second half to its "
      "first one; false assumes a stationary start, as the paper does.");
  }
};

/// The motion with which a map begins.
struct FirstMotion {
  Vector6d velocity = Vector6d::Zero();  ///< [rho; theta] per second, body frame.
  bool is_at_rest = true;                ///< The body hardly moves.
  /// Whether a constant twist explains the whole interval: its two halves agree under it. Else the
  /// body accelerates or turns to and fro, or nobody knows how it moves.
  bool is_steady = true;
  /// Whether most points of the second half agree with it. Of a single sweep hardly any do: its
  /// halves see different things.
  bool is_shown = true;
  std::optional<Eigen::Vector3d> open_direction;  ///< See InitialMotion.
};

/// The motion over the first interval: the estimated one if it is believed, else rest.
FirstMotion MotionOfFirstInterval(const SegmentCloud& cloud, const InitializationOptions& options,
                                  const MapPyramidOptions& map_options,
                                  const RegistrationOptions& registration, ThreadPool* threads);

}  // namespace trajlo
