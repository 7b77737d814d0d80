// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/odometry/map/map_pyramid.h"
#include "core/odometry/parallel/thread_pool.h"
#include "core/odometry/segments/segment_cloud.h"
#include "factors/segment_linearizer.h"

namespace trajlo {

/// What a motion over the first interval would mean: the points of its first half as a map, moved
/// with it, and planes of that map for the points of its second half.
class MotionHypothesis {
 public:
  /// `tau` is the body's twist over the whole interval.
  MotionHypothesis(const SegmentCloud& interval, const std::vector<SegmentPoint>& second_half,
                   const Vector6d& tau, const MapPyramidOptions& map_options, ThreadPool* threads);

  RegistrationNormalEquations Linearize(const RegistrationNoise& noise) const;

  /// How many points of the second half agree: they lie within 5 cm of their planes.
  int Agreeing() const;
  /// How many points have a plane.
  int WithPlane() const { return static_cast<int>(points_.size()); }

  /// Of planes that face `direction` (a unit vector in the world). These tell how far one has moved
  /// along it, whatever the others say.
  int AgreeingAlong(const Eigen::Vector3d& direction) const;
  int FacingAlong(const Eigen::Vector3d& direction) const;

  /// How many of AgreeingAlong() count by themselves. No moment and no place (a cube of `place_m`)
  /// has more than a few: its points share an error, or are one thing. Where a scanner bounces, the
  /// rings of two sweeps stand above each other behind it, and seem to be a wall that goes along. A
  /// car may go along, too.
  int VotesAlong(const Eigen::Vector3d& direction, double place_m) const;

 private:
  /// Calls function(point) with every point that agrees.
  template <typename Function>
  void ForEachAgreeing(const Function& function) const;

  SE3 T_end_;
  std::vector<RegistrationPoint> points_;  ///< Those that have a plane.
};

}  // namespace trajlo
