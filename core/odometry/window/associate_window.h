// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/map/map_pyramid.h"
#include "core/odometry/parallel/parallel_for.h"
#include "core/odometry/window/window.h"

namespace trajlo {

/// Finds the planes of all points of the window, each at its own time on the present poses.
/// Segments that lie where they did at their last look-up keep their planes. Returns the number of
/// look-ups.
int AssociateWindow(const MapPyramid& map, ThreadPool* threads, Window* window);

}  // namespace trajlo
