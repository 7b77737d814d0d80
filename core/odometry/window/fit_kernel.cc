// SPDX-License-Identifier: MIT
#include "core/odometry/window/fit_kernel.h"

#include <algorithm>
#include <cmath>

#include "core/odometry/window/point_scatter.h"

namespace trajlo {
namespace {

/// A smaller change is not worth a new linearisation of all segments.
constexpr double kSmallChange = 0.05;

}  // namespace

void FitKernel(const RegistrationOptions& options, Window* window) {
  const bool has_kernel = window->noise.kernel.kind != KernelKind::kNone;
  if (!has_kernel || options.kernel_in_spreads == 0.0) return;
  const double scatter_m = WeightedPointScatter(*window);
  if (scatter_m == 0.0) return;
  const double width_m =
      std::min(std::max(options.kernel_in_spreads * scatter_m, options.sigma_m), options.kernel_m);
  double& width = window->noise.kernel.width;
  const double change = width_m / window->noise.sigma_m - width;
  if (std::abs(change) <= kSmallChange * width) return;
  width += change;
  for (Segment& segment : window->segments) segment.linearization.reset();
}

}  // namespace trajlo
