// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/odometry/rig/rig_calibration.h"
#include "core/odometry/segments/lidar_correction.h"
#include "manifolds/se3.h"

namespace trajlo {

/// Where a LiDAR was found to be, and its clock; see RigCalibration.
struct LidarPlace {
  std::size_t lidar = 0;
  SE3 T_body_lidar;             ///< As found.
  double clock_offset_s = 0.0;  ///< As input.clock_offset_s takes it.
  double moved_m = 0.0;         ///< From where it was said to be.
  double turned_rad = 0.0;      ///< Likewise.
  double clock_moved_s = 0.0;   ///< Likewise.
  RigEvidence evidence = RigEvidence::kNotYet;
};

/// A LiDAR by the pose and clock offset that were given, and what they are corrected by.
LidarPlace CorrectedPlace(std::size_t lidar, const SE3& T_body_lidar, double clock_offset_s,
                          const LidarCorrection& correction, RigEvidence evidence);

/// "LiDAR 1 by 0.012 m, 0.35 degrees and 4.8 ms": of all that are known, but those that stayed.
/// Empty if there is none.
std::string CorrectionsText(const std::vector<LidarPlace>& rig);

/// One for each LiDAR that is farther off than any calibration or drawing should be, or of which
/// that cannot be told.
std::vector<std::string> RigWarnings(const std::vector<LidarPlace>& rig);

}  // namespace trajlo
