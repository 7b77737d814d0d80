// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/simulation/random/counter_random.h"

/// The small smooth functions of time that motions are made of.
namespace trajlo::simulation {

/// From 0 (x <= 0) to 1 (x >= 1) with three continuous derivatives.
inline double SmoothStep(double x) {
  x = std::clamp(x, 0.0, 1.0);
  const double x2 = x * x;
  return x2 * x2 * (35.0 + x * (-84.0 + x * (70.0 - 20.0 * x)));
}

/// The integral of SmoothStep from 0 to x, for any x.
inline double SmoothStepIntegral(double x) {
  if (x <= 0.0) return 0.0;
  if (x >= 1.0) return x - 0.5;
  const double x2 = x * x;
  return x2 * x2 * x * (7.0 + x * (-14.0 + x * (10.0 - 2.5 * x)));
}

/// The Taylor series of sin(r)/r in r², last term first: exact to 1e-14 for |r| <= pi/2.
constexpr std::array<double, 10> kSineSeries = {-1.0 / 121645100408832000.0,
                                                1.0 / 355687428096000.0,
                                                -1.0 / 1307674368000.0,
                                                1.0 / 6227020800.0,
                                                -1.0 / 39916800.0,
                                                1.0 / 362880.0,
                                                -1.0 / 5040.0,
                                                1.0 / 120.0,
                                                -1.0 / 6.0,
                                                1.0};

/// sin(x) to within 2e-13, several times as fast as the library's for the large arguments that a
/// phase grows to. A body that shakes asks for thirty sines at every shot of the laser.
inline double FastSine(double x) {
  // x = k pi + r with |r| <= pi/2; pi in two parts keeps the digits of r.
  const double k = std::nearbyint(x * M_1_PI);
  const double r = (x - k * 3.141592653589793116) - k * 1.2246467991473532e-16;
  const double r2 = r * r;
  double series = 0.0;
  for (const double coefficient : kSineSeries) series = series * r2 + coefficient;
  const bool odd = (static_cast<std::int64_t>(k) & 1) != 0;
  return odd ? -r * series : r * series;
}

/// A bounded wobble: a sum of sinusoids whose frequencies and phases are drawn from a seed. Its
/// peak is at most `peak`.
class Jitter {
 public:
  Jitter(std::uint64_t seed, std::uint64_t channel, double low_hz, double high_hz, double peak,
         int terms = 3) {
    CounterRandom random(seed, 0x6a177e5, channel);
    for (int i = 0; i < terms; ++i) {
      // One term in each part of the band, so that no seed leaves a part of it empty.
      const double part = (high_hz - low_hz) / terms;
      const double hz = low_hz + part * (i + random.Uniform());
      terms_.push_back({peak / terms, 2.0 * M_PI * hz, random.Uniform(0.0, 2.0 * M_PI)});
    }
  }
  double operator()(double t_s) const {
    double sum = 0.0;
    for (const Term& term : terms_) sum += term.amplitude * FastSine(term.omega * t_s + term.phase);
    return sum;
  }

 private:
  struct Term {
    double amplitude, omega, phase;
  };
  std::vector<Term> terms_;
};

}  // namespace trajlo::simulation
