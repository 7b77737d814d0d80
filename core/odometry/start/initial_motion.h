// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/odometry/odometry_options.h"
#include "core/odometry/parallel/thread_pool.h"
#include "core/odometry/segments/segment_cloud.h"

namespace trajlo {

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
  /// The direction of translation in the frame of the first pose that hardly any point holds, if
  /// there is one; none where the few that tell say that the body is at rest.
  std::optional<Eigen::Vector3d> open_direction;
};

/// Finds how the body moved during the first interval from nothing but the interval itself: the
/// points of its second half, each at its own time on Exp(alpha tau), are registered to those of
/// its first half, which move with the same tau. A wrong tau blurs the first half by a third of
/// what it displaces the second, so each round leaves about a third of the error. The voxels start
/// coarse and shrink. Where one direction is held weakly, the search is started at many speeds
/// along it: on a motorway the ground agrees with all of them. A motion that is not believed is
/// rest.
FirstMotion MotionOfFirstInterval(const SegmentCloud& cloud, const OdometryOptions& options,
                                  ThreadPool* threads);

}  // namespace trajlo
