// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/simulation/sensors/sensor_model.h"

namespace trajlo::simulation {

/// What is wrong with one laser throughout a recording: no sensor is calibrated perfectly.
struct LaserError {
  double range_m = 0.0;
  /// Two small angles about axes across the beam.
  double up_rad = 0.0;
  double left_rad = 0.0;
};

/// One for each laser of a LiDAR, normal with the standard deviations of its model; the same for
/// the same seed.
std::vector<LaserError> DrawLaserErrors(const SensorModel& sensor, std::uint64_t seed,
                                        int lidar_id);

/// A direction (a unit vector) turned up and to the left by small angles, as the sensor's z axis
/// has it.
Eigen::Vector3d Turned(const Eigen::Vector3d& direction, double up_rad, double left_rad);

}  // namespace trajlo::simulation
