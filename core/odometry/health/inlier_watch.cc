// SPDX-License-Identifier: MIT
#include "core/odometry/health/inlier_watch.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "core/scans/median.h"

namespace trajlo {
namespace {

/// What is usual is the median over this time: elsewhere, something else becomes usual soon.
constexpr std::int64_t kUsual_ns = 10'000'000'000;
/// Of what is usual. At the right place it hardly ever is below three quarters, behind a quick turn
/// for a moment.
constexpr double kFewOfUsual = 2.0 / 3.0;
/// The median over this time is above 0.85 at the right place, unless many points are wrong. With
/// twice the speed along a street it is 0.75.
constexpr std::int64_t kAgreeing_ns = 1'000'000'000;
constexpr double kMinAgreement = 0.8;

}  // namespace

bool InlierWatch::HasFew(const WindowStatistics& window) {
  const double share = window.InlierShare();
  const std::int64_t usual_since_ns = window.end_ns - kUsual_ns;
  recent_.push_back({window.end_ns, share, window.agreement});
  while (recent_.front().end_ns < usual_since_ns) recent_.pop_front();
  return window.HasFewInliers() || share < kFewOfUsual * Usual(&Past::share, usual_since_ns) ||
         Usual(&Past::agreement, window.end_ns - kAgreeing_ns) < kMinAgreement;
}

double InlierWatch::Usual(double Past::*value, std::int64_t begin_ns) const {
  std::vector<double> values;
  for (auto window = recent_.rbegin(); window != recent_.rend(); ++window) {
    if (window->end_ns < begin_ns) break;
    values.push_back((*window).*value);
  }
  return LowerMedian(std::move(values));
}

}  // namespace trajlo
