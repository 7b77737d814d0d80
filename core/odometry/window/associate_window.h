// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/map/map_pyramid.h"
#include "core/odometry/parallel/parallel_for.h"
#include "core/odometry/window/window.h"

namespace trajlo {

/// Finds the planes of all points of the window, each at its own time on the present poses. `renew`
/// also looks up again the points that found no plane before (the map may have grown since).
/// Returns the number of look-ups.
int AssociateWindow(const MapPyramid& map, const AssociationOptions& options, double threshold_m,
                    bool renew, ThreadPool* threads, Window* window);

}  // namespace trajlo
