// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "core/options/describe.h"
#include "factors/segment_linearizer.h"

namespace trajlo {

/// A kernel that is fitted is at most this many times as wide as RegistrationOptions::kernel_m.
constexpr double kWidestKernel = 3.0;

inline Names<KernelKind> KernelNames() {
  return {{"none", KernelKind::kNone},
          {"huber", KernelKind::kHuber},
          {"cauchy", KernelKind::kCauchy},
          {"geman_mcclure", KernelKind::kGemanMcClure},
          {"tukey", KernelKind::kTukey}};
}

/// How a point's distance to its plane is weighed.
struct RegistrationOptions {
  double sigma_m = 0.03;
  double points_per_error = 5.0;
  KernelKind kernel = KernelKind::kCauchy;
  double kernel_m = 0.1;
  double kernel_in_spreads = 1.5;

  template <typename Describer>
  void Describe(Describer& d) {
    d(OptionFor::kUsers, "sigma_m", sigma_m, Range<double>{1e-4, 10.0},
      "Standard deviation of a point's distance to its plane.");
    d(OptionFor::kExperts, "points_per_error", points_per_error, Range<double>{1.0, 1e6},
      "Points on the same surface share its error: this many count as one measurement.");
    d(OptionFor::kExperts, "kernel", kernel, KernelNames(), "Robust kernel on that distance.");
    d(OptionFor::kExperts, "kernel_m", kernel_m, Range<double>{1e-3, 100.0},
      "Width of the kernel, if it is not fitted; else at most three times that.");
    d(OptionFor::kExperts, "kernel_in_spreads", kernel_in_spreads, Range<double>{0.0, 100.0},
      "Width of the kernel in each direction, as a multiple of the spread of the distances of the "
      "points that constrain it, but at least sigma_m; 0: always kernel_m.");
  }
};

/// What the factors take: errors that are shared make sigma larger.
inline RegistrationNoise MakeRegistrationNoise(const RegistrationOptions& options) {
  const double sigma_m = options.sigma_m * std::sqrt(options.points_per_error);
  return {sigma_m, {options.kernel, options.kernel_m / sigma_m}};
}

}  // namespace trajlo
