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
  /// Width of the kernel.
  double kernel_m = 0.1;
};

/// What the factors take: errors that are shared make sigma larger.
RegistrationNoise MakeRegistrationNoise(const RegistrationOptions& options);

}  // namespace trajlo
