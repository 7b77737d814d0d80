// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/simulation/sensors/scan_pattern.h"

namespace trajlo::simulation {

/// What a LiDAR gets wrong. Standard deviations are of zero-mean normal noise.
struct MeasurementModel {
  double range_sigma_m = 0.02;
  /// Of each of the two angles across the beam; the point is reported along the nominal direction.
  double angle_sigma_rad = 0.0;
  /// Share of the returns that are lost at random.
  double dropout_fraction = 0.01;
  double min_range_m = 0.5;
  double max_range_m = 100.0;
  /// What is wrong with each laser throughout a recording: its range, and its direction (about each
  /// of the two axes across it; its points are reported along the nominal one).
  double laser_range_sigma_m = 0.0;
  double laser_angle_sigma_rad = 0.0;
  /// Full width of a beam. Where it lights two surfaces at once, the range is a mixture.
  double divergence_rad = 0.0;
  /// Share of the beams that something in the air sends back: rain, snow, dust. How far they get
  /// is distributed exponentially with this mean; those that would get to a surface return it.
  double clutter_fraction = 0.0;
  double clutter_range_m = 5.0;
};

/// A LiDAR: where and when it looks, and how well it measures.
struct SensorModel {
  std::string name;
  std::shared_ptr<const ScanPattern> pattern;
  MeasurementModel measurement;
};

/// Makes a sensor by name: os1_16, os0_64, os1_128, vlp16, hdl32e, hdl64e, pandar_xt32, mid70,
/// avia, mid360. `columns` replaces the number of firings around (0 keeps the sensor's own; the
/// Livox patterns have none). Throws std::invalid_argument for an unknown name.
SensorModel MakeSensor(const std::string& name, int columns = 0);

/// The names that MakeSensor knows.
std::vector<std::string> SensorNames();

}  // namespace trajlo::simulation
