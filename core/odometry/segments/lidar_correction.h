// SPDX-License-Identifier: MIT
#pragma once

#include "manifolds/se3.h"

namespace trajlo {

/// What was found to be wrong with the place and the clock of a LiDAR: a point at p_body and t is
/// at T_body p_body, and was measured at t + clock_s. See RigCalibration.
struct LidarCorrection {
  SE3 T_body;
  double clock_s = 0.0;
};

}  // namespace trajlo
