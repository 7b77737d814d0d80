// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/window/window_equations.h"

namespace trajlo {

/// The covariance of the right perturbation [rho; theta] (m², m rad, rad²) of pose k, given all
/// that the window knows: that block of the inverse of H. It takes the map for exact. NaN where H
/// is singular.
Matrix6d PoseCovariance(const WindowNormalEquations& window, int k);

/// A covariance whose translation and rotation are off by the factors `scale`, put right.
///
/// The noise of the points is set on the safe side, and at rest or with good planes they scatter
/// less; errors of planes move the map and the poses alike. What is left shows in the corrections
/// that new points make. If all covariances of a window are too large by a factor, the corrections
/// are smaller than it expects by the same factor, and MotionPrior::surprise() has measured it. So
/// nothing is set by hand.
Matrix6d CalibratedCovariance(const Matrix6d& covariance, const Eigen::Vector2d& scale);

}  // namespace trajlo
