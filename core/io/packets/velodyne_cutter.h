// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace trajlo {

/// Decides with which firing a new sweep begins: where the azimuth passes the cut angle; also after
/// a gap, and when a sweep grows too long because the sensor does not turn.
class VelodyneCutter {
 public:
  explicit VelodyneCutter(double cut_deg) : cut_cdeg_(100.0 * cut_deg) {}

  /// True if this firing is the first of a sweep, as the very first one is. Firings come in the
  /// order of time.
  bool StartsSweep(double azimuth_cdeg, std::int64_t t_ns);

 private:
  double cut_cdeg_ = 0.0;
  bool started_ = false;
  /// Has seen the far side since the cut: an encoder that jitters about the cut angle cuts once.
  bool armed_ = true;
  /// Azimuth since the cut angle, of the firing before.
  double last_cdeg_ = 0.0;
  std::int64_t last_ns_ = 0;
  std::int64_t start_ns_ = 0;
};

}  // namespace trajlo
