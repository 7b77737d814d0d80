// SPDX-License-Identifier: MIT
#include "core/odometry/window/point_scatter.h"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/odometry/segments/choose_evenly.h"
#include "core/scans/median.h"
#include "factors/plane_distances.h"

namespace trajlo {
namespace {

/// Fewer points have no scatter.
constexpr std::size_t kFewest = 20;
/// About this many points of each segment are asked.
constexpr std::size_t kAsked = 128;

}  // namespace

double PointScatter(const Window& window) {
  std::vector<double> sampled;
  for (int k = 0; k < window.size(); ++k) {
    const Segment& segment = window.At(k);
    ForEachDistance(segment.points, window.Motion(k), StrideForAbout(kAsked, segment.points.size()),
                    [&](const RegistrationPoint&, double distance_m) {
                      sampled.push_back(std::abs(distance_m));
                    });
  }
  if (sampled.size() < kFewest) return 0.0;
  return kSigmaOfMedian * UpperMedian(std::move(sampled));
}

}  // namespace trajlo
