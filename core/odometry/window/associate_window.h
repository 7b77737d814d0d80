// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/map/map_pyramid.h"
#include "core/odometry/parallel/thread_pool.h"
#include "core/odometry/window/window.h"

namespace trajlo {

/// Finds the planes of all points of the window, each at its own time on the present poses; those
/// that are still in the same cell of the map keep theirs, and so do segments that have not moved.
/// Returns the number of look-ups.
int AssociateWindow(const MapPyramid& map, const StepSize& tolerance, ThreadPool* threads,
                    Window* window);

}  // namespace trajlo
