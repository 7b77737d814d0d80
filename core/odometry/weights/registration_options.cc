// SPDX-License-Identifier: MIT
#include "core/odometry/weights/registration_options.h"

#include <algorithm>
#include <cmath>

namespace trajlo {

RegistrationNoise MakeRegistrationNoise(const RegistrationOptions& options, double kernel_m) {
  const double sigma_m = options.sigma_m * std::sqrt(options.points_per_error);
  return {sigma_m, {options.kernel, kernel_m / sigma_m}};
}

double KernelWidth_m(const RegistrationOptions& options, double threshold_m) {
  return std::clamp(options.kernel_in_thresholds * threshold_m, options.min_kernel_m,
                    options.max_kernel_m);
}

}  // namespace trajlo
