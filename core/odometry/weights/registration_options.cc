// SPDX-License-Identifier: MIT
#include "core/odometry/weights/registration_options.h"

#include <cmath>

namespace trajlo {

RegistrationNoise MakeRegistrationNoise(const RegistrationOptions& options) {
  const double sigma_m = options.sigma_m * std::sqrt(options.points_per_error);
  return {sigma_m, {options.kernel, options.kernel_m / sigma_m}};
}

}  // namespace trajlo
