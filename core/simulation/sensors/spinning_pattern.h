// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/simulation/sensors/scan_pattern.h"

namespace trajlo::simulation {

/// One laser of a spinning head.
struct Beam {
  double elevation_deg = 0.0;
  /// Against the head's azimuth, counter-clockwise.
  double azimuth_offset_deg = 0.0;
  /// After the start of the firing cycle.
  double offset_us = 0.0;
};

/// A head that turns once a scan, clockwise as seen from above, and fires all its beams in every
/// column.
struct SpinningParameters {
  std::vector<Beam> beams;
  int columns = 1024;
  /// From column to column.
  double column_us = 100000.0 / 1024.0;
  std::int64_t period_ns = 100'000'000;
  /// Where the sweep starts, counter-clockwise from x: 180 is the rear.
  double start_azimuth_deg = 180.0;
};

class SpinningPattern final : public ScanPattern {
 public:
  explicit SpinningPattern(const SpinningParameters& parameters);
  std::int64_t period_ns() const override { return period_ns_; }
  int firings_per_scan() const override { return static_cast<int>(firings_.size()); }
  int lasers() const override { return lasers_; }
  Firing At(std::int64_t /*scan*/, int firing) const override {
    return firings_[static_cast<std::size_t>(firing)];
  }

 private:
  std::int64_t period_ns_;
  int lasers_;
  std::vector<Firing> firings_;
};

}  // namespace trajlo::simulation
