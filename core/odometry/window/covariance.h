// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/window/window_equations.h"

namespace trajlo {

/// The covariance of the right perturbation [rho; theta] (m², m rad, rad²) of pose k, given all
/// that the window knows: that block of the inverse of H. It takes the map for exact. NaN where H
/// is singular.
Matrix6d PoseCovariance(const WindowNormalEquations& window, int k);

}  // namespace trajlo
