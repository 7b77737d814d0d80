// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/health/loss_watch.h"
#include "core/odometry/window/window.h"

namespace trajlo {

/// Whether the solution is finite, and the newest pose no farther from its prediction than a sensor
/// can have moved.
bool IsBelievable(const WindowStatistics& statistics, const LostOptions& options);

/// Puts the poses back to `poses`. The planes belong to poses that are not believed: the
/// registration is forgotten.
void Revert(const std::vector<SE3>& poses, Window* window);

/// Sets the flags of a window from how its solve went and from how its points hold it. Of its
/// segments the newest is looked at: it learns what the noise of its normals feigns.
void Judge(const LostOptions& options, double points_per_error, Window* window,
           WindowStatistics* statistics);

}  // namespace trajlo
