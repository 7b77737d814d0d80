// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/window/deskew.h"
#include "core/odometry/window/window.h"

namespace trajlo {

/// A window without segments, held at its one control pose by the anchor, at rest.
Window MakeWindow(std::int64_t begin_ns, const SE3& T_world_begin);

/// Adds a segment that begins where the window ends. Its control pose is predicted by `velocity`
/// ([rho; theta] per second, body frame), to which the first segment of a window is tied.
void PushSegment(SegmentCloud cloud, const Vector6d& velocity, Deskewing deskewing, Window* window);

}  // namespace trajlo
