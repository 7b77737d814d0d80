// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace trajlo {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

inline double Seconds(std::int64_t t_ns) { return 1e-9 * static_cast<double>(t_ns); }

/// Rounded; beyond 100 years (also infinity) it is 100 years, so that sums do not overflow.
inline std::int64_t Nanoseconds(double t_s) {
  constexpr double kLimit_s = 3.2e9;
  return std::llround(1e9 * std::clamp(t_s, -kLimit_s, kLimit_s));
}

}  // namespace trajlo
