// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "core/odometry/map/map_pyramid.h"
#include "core/odometry/parallel/thread_pool.h"
#include "core/odometry/segments/segment_cloud.h"
#include "core/odometry/start/place_search.h"
#include "core/odometry/weights/registration_options.h"

namespace trajlo {

/// Where a sweep was measured, and how the body moved during it.
struct SweepMotion {
  SE3 T_world_begin;
  Vector6d tau = Vector6d::Zero();  ///< The body's twist over the sweep.
};

/// Finds where in the map a short sweep was measured, within `region`. `tau` is roughly the body's
/// twist over the sweep; that of a sweep without duration is not refined.
///
/// Places are looked for in cells of the map (FindPlaces), refined by registration to its planes,
/// and judged against each other. A point speaks for a place if it lies on a plane there, and its
/// ray goes through nothing that the map has. The place with the most such points is returned only
/// if it is clear: half of all points must speak for it; most that have a plane must be on it; they
/// must hold all directions; and of those that speak for it or a rival alone, three of four must
/// speak for it. So a hall with two equal ends, a corridor, and a scene that is not in the map give
/// nothing. Nor does what is no larger than a hand before the LiDAR, nor a place that the
/// refinement reaches outside of `region`.
std::optional<SweepMotion> Relocalize(const SegmentCloud& sweep, const Vector6d& tau,
                                      const MapPyramid& map, const SearchRegion& region,
                                      const RegistrationOptions& registration, ThreadPool* threads);

}  // namespace trajlo
