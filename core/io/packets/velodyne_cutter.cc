// SPDX-License-Identifier: MIT
#include "core/io/packets/velodyne_cutter.h"

#include <cmath>

namespace trajlo {
namespace {

constexpr double kTurnCdeg = 36000.0;
/// Half a turn at the highest speed, 20 Hz.
constexpr std::int64_t kGapNs = 25'000'000;
/// The slowest turn takes 0.2 s.
constexpr std::int64_t kLongestSweepNs = 1'000'000'000;

}  // namespace

bool VelodyneCutter::StartsSweep(double azimuth_cdeg, std::int64_t t_ns) {
  double since_cut = std::fmod(azimuth_cdeg - cut_cdeg_, kTurnCdeg);
  if (since_cut < 0.0) since_cut += kTurnCdeg;
  const bool gap = t_ns - last_ns_ > kGapNs || t_ns < last_ns_;
  const bool passed = armed_ && since_cut < last_cdeg_ - kTurnCdeg / 4.0;
  const bool starts = !started_ || gap || passed || t_ns - start_ns_ > kLongestSweepNs;
  if (starts) {
    armed_ = !passed;
    start_ns_ = t_ns;
    started_ = true;
  }
  if (since_cut > kTurnCdeg / 4.0 && since_cut < kTurnCdeg * 3.0 / 4.0) armed_ = true;
  last_cdeg_ = since_cut;
  last_ns_ = t_ns;
  return starts;
}

}  // namespace trajlo
