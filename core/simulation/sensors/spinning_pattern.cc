// SPDX-License-Identifier: MIT
#include "core/simulation/sensors/spinning_pattern.h"

#include <cmath>

namespace trajlo::simulation {

SpinningPattern::SpinningPattern(const SpinningParameters& parameters)
    : period_ns_(parameters.period_ns), lasers_(static_cast<int>(parameters.beams.size())) {
  constexpr double kRadPerDeg = M_PI / 180.0;
  const double period_us = static_cast<double>(parameters.period_ns) * 1e-3;
  firings_.reserve(parameters.beams.size() * static_cast<std::size_t>(parameters.columns));
  for (int column = 0; column < parameters.columns; ++column) {
    for (const Beam& beam : parameters.beams) {
      const double t_us = column * parameters.column_us + beam.offset_us;
      // The head keeps turning while a column fires, so the azimuth follows the beam's own time.
      const double azimuth = kRadPerDeg * (parameters.start_azimuth_deg + beam.azimuth_offset_deg -
                                           360.0 * t_us / period_us);
      const double elevation = kRadPerDeg * beam.elevation_deg;
      firings_.push_back({{std::cos(elevation) * std::cos(azimuth),
                           std::cos(elevation) * std::sin(azimuth), std::sin(elevation)},
                          std::llround(t_us * 1e3)});
    }
  }
}

}  // namespace trajlo::simulation
