// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/window/window.h"

namespace trajlo {

/// How far the points moved the newest control pose from where the motion prior had put it, and how
/// far they should have, by component [rho; theta] of the body frame.
struct Innovation {
  Vector6d correction;  ///< The estimated pose ⊖ the predicted one (m, rad).
  /// What the variance of the correction should be: the covariance of the pose without the points
  /// of its segment, less that with them (the mean of a posterior varies by as much as the
  /// posterior is narrower than the prior). Near 0 where the points tell nothing.
  Vector6d expected_variance;
  /// The share of the predicted variance that the points take away, 0 to 1.
  Vector6d gain;
};

/// Of a solved window. `T_world_predicted`: where its newest pose was predicted.
Innovation MeasureInnovation(const Window& window, const SE3& T_world_predicted);

}  // namespace trajlo
