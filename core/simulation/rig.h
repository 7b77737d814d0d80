// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/simulation/sensors/sensor_model.h"
#include "manifolds/se3.h"

namespace trajlo::simulation {

/// One LiDAR of a rig.
struct LidarConfig {
  /// See MakeSensor.
  std::string sensor = "os1_16";
  int columns = 0;
  MeasurementModel measurement;
  SE3 T_body_lidar;
  /// When its first sweep starts, after the start of the recording.
  double phase_s = 0.0;
  /// What its clock shows more than the true time.
  double clock_offset_s = 0.0;
};

/// A LiDAR with the measurement model that its sensor comes with.
inline LidarConfig MakeLidar(const std::string& sensor, const SE3& T_body_lidar = SE3(),
                             int columns = 0) {
  LidarConfig lidar;
  lidar.sensor = sensor;
  lidar.columns = columns;
  lidar.measurement = MakeSensor(sensor, columns).measurement;
  lidar.T_body_lidar = T_body_lidar;
  return lidar;
}

}  // namespace trajlo::simulation
