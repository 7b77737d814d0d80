// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/simulation/sensors/scan_pattern.h"

namespace trajlo::simulation {

/// Two counter-rotating wedge prisms bend the beam: in the plane of angles its deflection is the
/// sum of two turning vectors (the paraxial model), which draws a rosette that never repeats.
///   (yaw, pitch) = d1 (cos w1 t, sin w1 t) + d2 (cos w2 t, sin w2 t) + (0, line offset)
/// The speeds of 7294 and -4664 turns a minute are those measured on a Livox Mid-40 by Brazeal,
/// Wilkinson and Hochmair, A rigorous observation model for the Risley prism-based Livox Mid-40,
/// Sensors 21(14) 4722, 2021; field of view, rate and number of lines come from the data sheets.
struct RosetteParameters {
  double deflection_1_deg = 17.6;
  double deflection_2_deg = 17.6;
  double speed_1_rpm = 7294.0;
  double speed_2_rpm = -4664.0;
  /// Vertical offsets of the lasers, which fire in turn.
  std::vector<double> line_offsets_deg = {0.0};
  double points_per_second = 100'000.0;
  std::int64_t period_ns = 100'000'000;
};

class RosettePattern final : public ScanPattern {
 public:
  explicit RosettePattern(const RosetteParameters& parameters) : parameters_(parameters) {}
  std::int64_t period_ns() const override { return parameters_.period_ns; }
  int firings_per_scan() const override;
  int lasers() const override { return static_cast<int>(parameters_.line_offsets_deg.size()); }
  Firing At(std::int64_t scan, int firing) const override;

 private:
  RosetteParameters parameters_;
};

/// All around, with an elevation that nods much faster than the azimuth turns and not in step with
/// it. The MID-360's field of view, rate and four lines are published, its mechanics are not: this
/// has the published figures and covers the same band without repeating.
struct NoddingParameters {
  double elevation_low_deg = -7.22;
  double elevation_high_deg = 55.22;
  double turn_hz = 10.9;
  double nod_hz = 181.3;
  int lines = 4;
  double points_per_second = 200'000.0;
  std::int64_t period_ns = 100'000'000;
};

class NoddingPattern final : public ScanPattern {
 public:
  explicit NoddingPattern(const NoddingParameters& parameters) : parameters_(parameters) {}
  std::int64_t period_ns() const override { return parameters_.period_ns; }
  int firings_per_scan() const override;
  int lasers() const override { return parameters_.lines; }
  Firing At(std::int64_t scan, int firing) const override;

 private:
  NoddingParameters parameters_;
};

}  // namespace trajlo::simulation
