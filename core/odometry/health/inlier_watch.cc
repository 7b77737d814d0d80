// SPDX-License-Identifier: MIT
#include "core/odometry/health/inlier_watch.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace trajlo {
namespace {

/// What is usual is the median over this time: elsewhere, something else becomes usual soon.
constexpr std::int64_t kSpan_ns = 10'000'000'000;
/// Of what is usual. At the right place it hardly ever is below three quarters, behind a quick turn
/// for a moment.
constexpr double kFewOfUsual = 2.0 / 3.0;

}  // namespace

bool InlierWatch::HasFew(const WindowStatistics& window) {
  const double share = window.InlierShare();
  recent_.push_back({window.end_ns, share});
  while (recent_.front().end_ns < window.end_ns - kSpan_ns) recent_.pop_front();
  return share < min_share_ || share < kFewOfUsual * Usual();
}

double InlierWatch::Usual() const {
  std::vector<double> shares;
  shares.reserve(recent_.size());
  for (const Window& window : recent_) shares.push_back(window.share);
  const auto middle = shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2);
  std::nth_element(shares.begin(), middle, shares.end());
  return *middle;
}

}  // namespace trajlo
