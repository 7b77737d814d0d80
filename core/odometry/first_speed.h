// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "core/odometry/odometry_options.h"
#include "core/odometry/parallel/thread_pool.h"
#include "core/odometry/segments/segment_cloud.h"
#include "core/odometry/solvers/window_solver.h"
#include "core/odometry/start/initial_motion.h"

namespace trajlo {

/// How fast the body moves along `found.open_direction`: `found`, or the same with another speed
/// along it. The first `in_interval` of the `segments` are the interval of which `found` is the
/// motion.
///
/// Along a road, nearly all points agree with any speed, and in 0.3 s the few posts and signs that
/// do not agree with it hardly more often than chance would have it. Two things help. The longer
/// they are followed, the more of them are seen again: so trackers follow the body, each from
/// another speed. And traffic at the same speed looks as if all of it stood: its surfaces are
/// large, but few. So what counts is not how many points agree, but at how many places of the
/// tracker's world the surfaces that face the direction are seen again and again. A world is larger
/// than the traffic on it.
///
/// Another speed is taken only if it has clearly more places than any other that ends elsewhere,
/// and most of what faces the direction agrees with it as it does with `found`: a world that moves
/// has ever new places, and before a long row of houses chance finds some again.
FirstMotion FindFirstSpeed(const std::vector<SegmentCloud>& segments, std::size_t in_interval,
                           const FirstMotion& found, const OdometryOptions& options,
                           const WindowSolverFactory& make_solver, ThreadPool* threads);

}  // namespace trajlo
