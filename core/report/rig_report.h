// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "manifolds/se3.h"

namespace trajlo {

/// Where a LiDAR was found to be; see RigCalibration.
struct LidarPlace {
  std::size_t lidar = 0;
  SE3 T_body_lidar;         ///< As found.
  double moved_m = 0.0;     ///< From where it was said to be.
  double turned_rad = 0.0;  ///< Likewise.
  bool is_known = false;    ///< False: it was not seen from enough places.
};

LidarPlace ComparePlaces(std::size_t lidar, const SE3& T_body_lidar_given, const SE3& T_body_lidar,
                         bool is_known);

/// "LiDAR 1 by 0.012 m and 0.35 degrees": of all that are known, but those that did not move.
/// Empty if there is none.
std::string CorrectionsText(const std::vector<LidarPlace>& rig);

/// One for each LiDAR that is farther off than any calibration or drawing should be.
std::vector<std::string> RigWarnings(const std::vector<LidarPlace>& rig);

}  // namespace trajlo
