// SPDX-License-Identifier: MIT
#pragma once

#include "factors/segment_registration.h"

namespace trajlo {

/// How a point's distance to its plane is weighed.
struct RegistrationOptions {
  /// Standard deviation of the distance of one point: the range noise of the sensor, and the
  /// roughness of what the map takes for planes.
  double sigma_m = 0.03;
  /// Points that hit the same surface share the error of its plane: so many count as one.
  double points_per_error = 10.0;
  KernelKind kernel = KernelKind::kCauchy;
  /// Width of the kernel: this share of the adaptive threshold, within the bounds below.
  double kernel_in_thresholds = 0.33;
  double min_kernel_m = 0.1;
  double max_kernel_m = 0.1;
};

/// The noise with a kernel of `kernel_m`; errors that are shared make sigma larger.
RegistrationNoise MakeRegistrationNoise(const RegistrationOptions& options, double kernel_m);

/// The width of the kernel at an adaptive threshold.
double KernelWidth_m(const RegistrationOptions& options, double threshold_m);

}  // namespace trajlo
