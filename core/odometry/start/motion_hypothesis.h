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
  /// The map points of `interval` are its first half, or all of it to know its surfaces; its
  /// registration points are those of the second half. `tau` is the body's twist over all of it.
  MotionHypothesis(const SegmentCloud& interval, const Vector6d& tau,
                   const MapPyramidOptions& map_options, ThreadPool* threads);

  RegistrationNormalEquations Linearize(const RegistrationNoise& noise) const;
  /// The same, but planes that do not face `direction` (a unit vector in the world) say nothing
  /// about the way along it. A road has thousands of points, and the noise of their normals holds a
  /// speed that the few points which face the way would correct.
  RegistrationNormalEquations LinearizeAlong(const Eigen::Vector3d& direction,
                                             const RegistrationNoise& noise) const;

  /// How many points of the second half agree: they lie within 5 cm of their planes.
  int Agreeing() const;
  /// How many points have a plane.
  int WithPlane() const { return static_cast<int>(points_.size()); }

  /// Of planes that face `direction`. These tell how far one has moved along it, whatever the
  /// others say.
  int AgreeingAlong(const Eigen::Vector3d& direction) const;
  int FacingAlong(const Eigen::Vector3d& direction) const;
  /// The points of `second_half` (that of the interval) that may tell how far one has moved along
  /// `direction`: all but those on planes that do not face it. A few of these remain to hold the
  /// rest of the motion.
  std::vector<SegmentPoint> TellingAlong(const Eigen::Vector3d& direction,
                                         const std::vector<SegmentPoint>& second_half) const;

  /// How many of AgreeingAlong() count as independent. No moment and no place (a cube of `place_m`)
  /// has more than a few: its points share an error, or are one thing. Where a scanner bounces, the
  /// rings of two sweeps stand above each other behind it, and look like a wall that moves along.
  /// So may a car.
  int VotesAlong(const Eigen::Vector3d& direction, double place_m) const;

 private:
  /// Calls function(point) with every point that agrees.
  template <typename Function>
  void ForEachAgreeing(const Function& function) const;

  SE3 T_end_;
  std::vector<RegistrationPoint> points_;  ///< Those that have a plane.
};

}  // namespace trajlo
