// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

namespace trajlo::simulation {

/// The finaliser of SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators,
/// OOPSLA 2014): a bijection that turns counters into well-mixed bits.
inline std::uint64_t MixBits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

/// Random numbers that depend on their key alone, never on who drew before: any number of threads
/// in any order draws the same. The key is for instance (seed, lidar, scan, ray).
class CounterRandom {
 public:
  explicit CounterRandom(std::uint64_t a, std::uint64_t b = 0, std::uint64_t c = 0,
                         std::uint64_t d = 0)
      : state_(MixBits(MixBits(MixBits(MixBits(a) ^ b) ^ c) ^ d)) {}

  /// Uniform in [0, 1).
  double Uniform() {
    state_ += 0x9e3779b97f4a7c15ULL;
    return static_cast<double>(MixBits(state_) >> 11U) * 0x1.0p-53;
  }
  /// Uniform in [low, high).
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }

  /// Standard normal, by Box and Muller; the second value of each pair is kept for the next call.
  double Gaussian() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform()));
    const double angle = 2.0 * M_PI * Uniform();
    spare_ = radius * std::sin(angle);
    has_spare_ = true;
    return radius * std::cos(angle);
  }

 private:
  std::uint64_t state_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace trajlo::simulation
