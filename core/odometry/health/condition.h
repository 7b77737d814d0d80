// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/window/window.h"

namespace trajlo {

/// How the points of a window hold it where they hold it least: a rigid motion of all its control
/// poses, in the frame of the newest one.
struct WindowCondition {
  /// Information (1/m²) about that motion that is no noise; 0 where all of it may be. The points
  /// alone give a standard deviation of 1 / sqrt(smallest_eigenvalue) metres.
  double smallest_eigenvalue = 0.0;
  /// [rho; theta], body frame, unit length. Rotations are in metres: at the lever arm at which the
  /// points hold rotations as well as translations.
  Vector6d weak_direction = Vector6d::Zero();
};

/// The smallest eigenvalue of
///
///   (1 - 6 / N) (H - (1 + 3 sqrt(2 / N_F)) F),
///
/// H the registration's information, F what the noise of normals feigns of it, and three standard
/// deviations more (FeignedInformation). Of N errors that are independent, six are spent on finding
/// the pose: with fewer, points agree whatever the pose is. `points_per_error` points share one.
WindowCondition ConditionOf(const Window& window, double points_per_error);

}  // namespace trajlo
