// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/health/window_statistics.h"
#include "core/odometry/weights/registration_options.h"
#include "core/odometry/window/window.h"

namespace trajlo {

/// Whether the solution is finite, the newest pose no farther from its prediction than 3 m and
/// 1 rad, and no pose farther from its neighbours than 100 m/s and 60 rad/s get it.
bool IsBelievable(const WindowStatistics& statistics, const Window& window);

/// Whether the points moved the newest pose from its prediction by more than 0.2 m, and than 10 g
/// move a body within its segment. Either this pose is wrong or those before it were.
bool HasJumped(const WindowStatistics& statistics, const Window& window);

/// Whether that speed and turn rate get a body from one pose to another in `duration_s`.
bool IsWithinReach(const SE3& T_world_begin, const SE3& T_world_end, double duration_s);

/// Puts the poses back to `poses`, which are predictions. The planes belong to poses that are not
/// believed: the registration is forgotten.
void Revert(const std::vector<SE3>& poses, Window* window);

/// Sets the flags of a window from how its solve went and from how its points hold it. Of its
/// segments the newest is looked at: its spurious information is found.
void Judge(const RegistrationOptions& registration, Window* window, WindowStatistics* statistics);

}  // namespace trajlo
