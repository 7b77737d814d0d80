// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/window/window.h"

namespace trajlo {

/// How the points of a window hold it: the information of a rigid motion of all control poses, in
/// the frame of the newest one, per point and unit sigma, rotations scaled to the same trace.
struct WindowCondition {
  double smallest_eigenvalue = 0.0;
  /// [rho; theta], body frame, in scaled units (rotations by the scale above), unit length.
  Vector6d weak_direction = Vector6d::Zero();
};
WindowCondition ConditionOf(const Window& window);

}  // namespace trajlo
