// SPDX-License-Identifier: MIT
#include "core/odometry/window/fit_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/scans/median.h"
#include "factors/plane_distances.h"

namespace trajlo {
namespace {

/// Fewer points have no spread.
constexpr std::size_t kFewest = 20;
/// Of each segment about so many are asked.
constexpr std::size_t kAsked = 128;
/// Of normally distributed values: their standard deviation in medians of their sizes.
constexpr double kSigmaOfMedian = 1.4826;
/// A smaller change is not worth a new linearisation of all segments.
constexpr double kSmallChange = 0.05;

std::vector<double> SampleDistances(const Window& window) {
  std::vector<double> sampled_m;
  for (int k = 0; k < window.size(); ++k) {
    const Segment& segment = window.segments[static_cast<std::size_t>(k)];
    ForEachDistance(segment.points, SegmentMotion(window.Pose(k), segment.T_world_end),
                    1 + segment.points.size() / kAsked,
                    [&](const RegistrationPoint& point, double distance_m) {
                      sampled_m.push_back(std::sqrt(point.weight) * std::abs(distance_m));
                    });
  }
  return sampled_m;
}

}  // namespace

void FitKernel(const RegistrationOptions& options, Window* window) {
  const bool has_kernel = window->noise.kernel.kind != KernelKind::kNone;
  if (!has_kernel || options.kernel_in_spreads == 0.0) return;
  std::vector<double> sampled_m = SampleDistances(*window);
  if (sampled_m.size() < kFewest) return;
  const double spread_m = kSigmaOfMedian * UpperMedian(std::move(sampled_m));
  const double width_m =
      std::min(std::max(options.kernel_in_spreads * spread_m, options.sigma_m), options.kernel_m);
  double& width = window->noise.kernel.width;
  const double change = width_m / window->noise.sigma_m - width;
  if (std::abs(change) <= kSmallChange * width) return;
  width += change;
  for (Segment& segment : window->segments) segment.linearization.reset();
}

}  // namespace trajlo
