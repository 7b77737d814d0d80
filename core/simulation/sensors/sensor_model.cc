// SPDX-License-Identifier: MIT
#include "core/simulation/sensors/sensor_model.h"

#include <array>
#include <functional>
#include <map>
#include <stdexcept>

#include "core/simulation/sensors/livox_pattern.h"
#include "core/simulation/sensors/spinning_pattern.h"

namespace trajlo::simulation {

namespace {

/// `count` beams at even steps from `top_deg` downwards.
std::vector<Beam> EvenBeams(int count, double top_deg, double bottom_deg) {
  std::vector<Beam> beams;
  beams.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    beams.push_back({top_deg + (bottom_deg - top_deg) * i / (count - 1), 0.0, 0.0});
  }
  return beams;
}

SensorModel Spinning(const std::string& name, SpinningParameters parameters, int columns,
                     const MeasurementModel& measurement) {
  if (columns > 0) {
    parameters.columns = columns;
    parameters.column_us = static_cast<double>(parameters.period_ns) * 1e-3 / columns;
  }
  return {name, std::make_shared<SpinningPattern>(parameters), measurement};
}

/// Ouster: all beams of a column fire at once, 1024 columns at 10 Hz, starting at the connector in
/// the rear. Fields of view: data sheets of the OS1 (first generation, 33.2°), the OS0 (90°) and
/// the OS1-128 (42.4°). The beams of a column are staggered by four azimuth offsets, as in the
/// sensors' metadata.
SensorModel Ouster(const std::string& name, int beams, double half_fov_deg,
                   const std::array<double, 4>& azimuth_offsets_deg, int columns,
                   const MeasurementModel& measurement) {
  SpinningParameters parameters;
  parameters.beams = EvenBeams(beams, half_fov_deg, -half_fov_deg);
  for (std::size_t i = 0; i < parameters.beams.size(); ++i) {
    parameters.beams[i].azimuth_offset_deg = azimuth_offsets_deg[i % 4];
  }
  return Spinning(name, parameters, columns, measurement);
}

/// Velodyne VLP-16 user manual: 16 lasers interleaved from -15° to 15°, 2.304 us between lasers,
/// 55.296 us a firing cycle.
SensorModel Vlp16(int columns) {
  SpinningParameters parameters;
  for (int laser = 0; laser < 16; ++laser) {
    const double elevation_deg = laser % 2 == 0 ? -15.0 + laser : laser;
    parameters.beams.push_back({elevation_deg, 0.0, 2.304 * laser});
  }
  parameters.columns = 1808;
  parameters.column_us = 55.296;
  return Spinning("vlp16", parameters, columns, {0.02, 0.0, 0.01, 0.5, 100.0});
}

/// Velodyne HDL-32E user manual: 32 lasers from -30.67° to 10.67° in steps of 4/3°, fired from the
/// lowest, alternating between the lower and the upper half; 1.152 us between lasers, 46.08 us a
/// cycle.
SensorModel Hdl32e(int columns) {
  SpinningParameters parameters;
  for (int laser = 0; laser < 32; ++laser) {
    const int step = laser % 2 == 0 ? laser / 2 : 16 + laser / 2;
    parameters.beams.push_back({-92.0 / 3.0 + step * 4.0 / 3.0, 0.0, 1.152 * laser});
  }
  parameters.columns = 2170;
  parameters.column_us = 46.08;
  return Spinning("hdl32e", parameters, columns, {0.02, 0.0, 0.01, 1.0, 80.0});
}

/// Velodyne HDL-64E S2 data sheet: 32 upper lasers from 2° down in steps of 1/3°, 32 lower ones
/// from -8.83° down in steps of 1/2°; the two halves fire together, 48 us a cycle (1.33 million
/// points a second).
SensorModel Hdl64e(int columns) {
  SpinningParameters parameters;
  for (int i = 0; i < 32; ++i) parameters.beams.push_back({2.0 - i / 3.0, 0.0, 1.5 * i});
  for (int i = 0; i < 32; ++i) parameters.beams.push_back({-8.83 - i / 2.0, 0.0, 1.5 * i});
  parameters.columns = 2083;
  parameters.column_us = 48.0;
  return Spinning("hdl64e", parameters, columns, {0.02, 0.0, 0.01, 1.5, 120.0});
}

/// Hesai PandarXT-32 user manual: 15° to -16° in steps of 1°, 1.512 us between channels after
/// 0.368 us, 50 us a block (0.18° at 10 Hz).
SensorModel PandarXt32(int columns) {
  SpinningParameters parameters;
  for (int channel = 0; channel < 32; ++channel) {
    parameters.beams.push_back({15.0 - channel, 0.0, 0.368 + 1.512 * channel});
  }
  parameters.columns = 2000;
  parameters.column_us = 50.0;
  parameters.start_azimuth_deg = 90.0;
  return Spinning("pandar_xt32", parameters, columns, {0.01, 0.0, 0.01, 0.3, 120.0});
}

/// Livox MID-70 user manual: a circle of 70.4°, 100,000 points a second.
SensorModel Mid70() {
  return {"mid70",
          std::make_shared<RosettePattern>(RosetteParameters{}),
          {0.02, 0.0, 0.01, 0.1, 130.0}};
}

/// Livox Avia user manual: 70.4° x 77.2°, six lines, 240,000 points a second. The six lines widen
/// the circle of 70.4° to the published height.
SensorModel Avia() {
  RosetteParameters parameters;
  parameters.line_offsets_deg = {3.4, 2.04, 0.68, -0.68, -2.04, -3.4};
  parameters.points_per_second = 240'000.0;
  return {"avia", std::make_shared<RosettePattern>(parameters), {0.02, 0.0, 0.01, 1.0, 190.0}};
}

/// Livox Mid-360 user manual: 360° x 59°, 200,000 points a second.
SensorModel Mid360() {
  return {"mid360",
          std::make_shared<NoddingPattern>(NoddingParameters{}),
          {0.02, 0.0, 0.01, 0.1, 70.0}};
}

using Maker = std::function<SensorModel(int columns)>;

const std::map<std::string, Maker>& Makers() {
  constexpr std::array<double, 4> kOs1Offsets = {3.164, 1.055, -1.055, -3.164};
  constexpr std::array<double, 4> kOs1Gen2Offsets = {4.21, 1.41, -1.41, -4.21};
  static const std::map<std::string, Maker> makers = {
      {"os1_16",
       [=](int columns) {
         return Ouster("os1_16", 16, 16.611, kOs1Offsets, columns, {0.02, 0.0, 0.01, 0.5, 100.0});
       }},
      {"os0_64",
       [=](int columns) {
         return Ouster("os0_64", 64, 45.0, {8.4, -2.8, 8.4, -2.8}, columns,
                       {0.02, 0.0, 0.01, 0.3, 50.0});
       }},
      {"os1_128",
       [=](int columns) {
         return Ouster("os1_128", 128, 21.2, kOs1Gen2Offsets, columns,
                       {0.015, 0.0, 0.01, 0.5, 120.0});
       }},
      {"vlp16", Vlp16},
      {"hdl32e", Hdl32e},
      {"hdl64e", Hdl64e},
      {"pandar_xt32", PandarXt32},
      {"mid70", [](int) { return Mid70(); }},
      {"avia", [](int) { return Avia(); }},
      {"mid360", [](int) { return Mid360(); }},
  };
  return makers;
}

}  // namespace

SensorModel MakeSensor(const std::string& name, int columns) {
  const auto maker = Makers().find(name);
  if (maker == Makers().end()) throw std::invalid_argument("unknown sensor '" + name + "'");
  return maker->second(columns);
}

std::vector<std::string> SensorNames() {
  std::vector<std::string> names;
  for (const auto& [name, maker] : Makers()) names.push_back(name);
  return names;
}

}  // namespace trajlo::simulation
