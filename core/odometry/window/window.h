// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "core/odometry/segments/segment_cloud.h"
#include "core/odometry/window/association.h"
#include "core/odometry/window/spurious_information.h"
#include "factors/marginalization_prior.h"
#include "factors/registration_point.h"
#include "factors/segment_linearizer.h"
#include "factors/smoothness.h"
#include "factors/white_noise_acceleration.h"
#include "manifolds/se3_interpolation.h"

namespace trajlo {

/// What ties a segment's velocity: nothing (the prior does), a known velocity, or the velocity of
/// the segment before it.
using MotionTerm = std::variant<std::monostate, SmoothnessTerm, WhiteNoiseAccelerationTerm>;

/// One segment of the window, and all that belongs to it.
struct Segment {
  SegmentCloud cloud;
  SE3 T_world_end;                        ///< The control pose at cloud.end_ns.
  SegmentAssociation association;         ///< Finds the planes of cloud.registration_points.
  std::vector<RegistrationPoint> points;  ///< Those that have one.
  double noise_factor = 1.0;  ///< See MotionPrior::noise_factor(): its guess when the segment came.
  double bend_m2 = 0.0;       ///< See MotionPrior::Bend_m2(): its guess when the segment came.
  MotionTerm motion;
  /// The registration around the present poses: to first order in the last step.
  RegistrationNormalEquations registration;
  /// What `registration` comes from; empty once `points` have changed.
  std::optional<LinearizedRegistration> linearization;
  /// The part of the information of the registration that comes from the noise of normals.
  SpuriousInformation spurious;
  /// WindowFlag bits of the window in which this segment was the newest, and of what showed later.
  unsigned flags = 0;

  double Duration_s() const { return cloud.Duration_s(); }
};

/// The sliding window: K segments and their K+1 control poses, and what is left of earlier ones.
///
///   E = sum_k registration_k(T_{k-1}, T_k) + sum_k motion_k + prior(T_0, ...)      (paper eq. 8)
struct Window {
  std::int64_t begin_ns = 0;
  SE3 T_world_begin;              ///< The control pose at begin_ns.
  unsigned begin_flags = 0;       ///< Of the segment that ended there.
  std::vector<Segment> segments;  ///< Oldest first.
  MarginalizationPrior prior;
  RegistrationNoise noise;  ///< Of a point of a segment without a bend; see NoiseOf().
  /// Columns: the directions with a kernel each. RegistrationPoint::axis is the one that a normal
  /// is nearest to; see FitKernel.
  Eigen::Matrix3d kernel_axes = Eigen::Matrix3d::Identity();
  /// Velocity at the start of a window that has no segments yet, [rho; theta] per second, body
  /// frame.
  Vector6d begin_velocity = Vector6d::Zero();
  /// False: the last solve failed, and the poses are predictions.
  bool is_believed = true;

  int size() const { return static_cast<int>(segments.size()); }
  const Segment& At(int k) const { return segments[static_cast<std::size_t>(k)]; }
  Segment& At(int k) { return segments[static_cast<std::size_t>(k)]; }
  /// The K+1 control poses, oldest first.
  const SE3& Pose(int k) const { return k == 0 ? T_world_begin : At(k - 1).T_world_end; }
  const SE3& EndPose() const { return Pose(size()); }
  /// The motion of the body over segment k.
  SegmentMotion Motion(int k) const { return {Pose(k), Pose(k + 1)}; }
  std::vector<SE3> Poses() const {
    std::vector<SE3> poses = {T_world_begin};
    for (const Segment& segment : segments) poses.push_back(segment.T_world_end);
    return poses;
  }
  std::int64_t EndNs() const { return segments.empty() ? begin_ns : segments.back().cloud.end_ns; }
  /// `poses` may be more than these.
  void SetPoses(const std::vector<SE3>& poses) {
    T_world_begin = poses.front();
    for (std::size_t k = 0; k < segments.size(); ++k) segments[k].T_world_end = poses[k + 1];
  }
  /// Where the next solve starts, far from where the last one ended.
  void BeginAgainAt(const std::vector<SE3>& poses) {
    SetPoses(poses);
    for (Segment& segment : segments) segment.linearization.reset();
  }
  /// Of each point of a segment. All N of them share its bend: together they tell as much as
  /// N / (k + N bend_m2 / sigma²) points without one, whose variance is not k times as large.
  RegistrationNoise NoiseOf(const Segment& segment) const {
    const auto points = static_cast<double>(segment.cloud.registration_points.size());
    return noise.SharedBy(segment.noise_factor +
                          points * segment.bend_m2 / (noise.sigma_m * noise.sigma_m));
  }
  /// The mean twist over segment k, [rho; theta] per second, in the body frame at its start.
  Vector6d Velocity(int k) const { return Minus(Pose(k + 1), Pose(k)) / At(k).Duration_s(); }
  Vector6d EndVelocity() const { return segments.empty() ? begin_velocity : Velocity(size() - 1); }
};

}  // namespace trajlo
