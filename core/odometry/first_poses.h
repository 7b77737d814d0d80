// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/odometry/odometry_options.h"
#include "core/odometry/parallel/thread_pool.h"
#include "core/odometry/segments/segment_cloud.h"
#include "core/odometry/solvers/window_solver.h"

namespace trajlo {

/// The control poses of `segments` at a constant twist ([rho; theta] per second, body frame): one
/// more than segments, the first of them the identity.
std::vector<SE3> ConstantTwist(const std::vector<SegmentCloud>& segments, const Vector6d& velocity);

/// The control poses of the first interval of a recording that begins in motion: one more than
/// `segments`, the first of them the identity. `velocity` is the mean one, [rho; theta] per second,
/// body frame, as far as it is known.
///
/// The poses of a constant twist are one place to begin. Others are where a tracker ends that has
/// the first segment for a map, and begins with that velocity, or at rest: it finds what a twist
/// cannot explain, but sees little at first. From each of them the halves of the interval are
/// brought together, and what makes most points agree is taken.
std::vector<SE3> FindFirstPoses(const std::vector<SegmentCloud>& segments, const Vector6d& velocity,
                                const OdometryOptions& options,
                                const WindowSolverFactory& make_solver, ThreadPool* threads);

}  // namespace trajlo
