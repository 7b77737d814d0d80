// SPDX-License-Identifier: MIT
#include "core/simulation/sensors/livox_pattern.h"

#include <cmath>

#include "core/scans/nanoseconds.h"

namespace trajlo::simulation {

namespace {

constexpr double kRadPerDeg = M_PI / 180.0;

int FiringsPerScan(double points_per_second, std::int64_t period_ns) {
  return static_cast<int>(std::llround(points_per_second * 1e-9 * static_cast<double>(period_ns)));
}

/// Within the scan; the firings are evenly spaced.
std::int64_t OffsetNs(int firing, double points_per_second) {
  return std::llround(firing * 1e9 / points_per_second);
}

Eigen::Vector3d Direction(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

/// The phase of something that turns at `hz`, at a time whose turns may be many.
double Phase(double hz, double t_s) { return 2.0 * M_PI * std::fmod(hz * t_s, 1.0); }

}  // namespace

int RosettePattern::firings_per_scan() const {
  return FiringsPerScan(parameters_.points_per_second, parameters_.period_ns);
}

Firing RosettePattern::At(std::int64_t scan, int firing) const {
  const std::int64_t offset_ns = OffsetNs(firing, parameters_.points_per_second);
  const double t_s = Seconds(scan * parameters_.period_ns + offset_ns);
  const double phase_1 = Phase(parameters_.speed_1_rpm / 60.0, t_s);
  const double phase_2 = Phase(parameters_.speed_2_rpm / 60.0, t_s);
  const double x = parameters_.deflection_1_deg * std::cos(phase_1) +
                   parameters_.deflection_2_deg * std::cos(phase_2);
  const double y = parameters_.deflection_1_deg * std::sin(phase_1) +
                   parameters_.deflection_2_deg * std::sin(phase_2);
  // The deflection is an angle from the optical axis, so that the field of view is a circle; a
  // line's laser is tilted as a whole.
  const double angle = kRadPerDeg * std::hypot(x, y);
  const double around = std::atan2(y, x);
  const Eigen::Vector3d direction(std::cos(angle), std::sin(angle) * std::cos(around),
                                  std::sin(angle) * std::sin(around));
  const std::size_t line = static_cast<std::size_t>(firing) % parameters_.line_offsets_deg.size();
  const double tilt = kRadPerDeg * parameters_.line_offsets_deg[line];
  return {{std::cos(tilt) * direction.x() - std::sin(tilt) * direction.z(), direction.y(),
           std::sin(tilt) * direction.x() + std::cos(tilt) * direction.z()},
          offset_ns};
}

int NoddingPattern::firings_per_scan() const {
  return FiringsPerScan(parameters_.points_per_second, parameters_.period_ns);
}

Firing NoddingPattern::At(std::int64_t scan, int firing) const {
  const std::int64_t offset_ns = OffsetNs(firing, parameters_.points_per_second);
  const double t_s = Seconds(scan * parameters_.period_ns + offset_ns);
  const double line_phase = 2.0 * M_PI * (firing % parameters_.lines) / parameters_.lines;
  const double middle = 0.5 * (parameters_.elevation_low_deg + parameters_.elevation_high_deg);
  const double half = 0.5 * (parameters_.elevation_high_deg - parameters_.elevation_low_deg);
  const double elevation = middle + half * std::sin(Phase(parameters_.nod_hz, t_s) + line_phase);
  return {Direction(-Phase(parameters_.turn_hz, t_s), kRadPerDeg * elevation), offset_ns};
}

}  // namespace trajlo::simulation
