// SPDX-License-Identifier: MIT
#include "core/odometry/health/loss_watch.h"

#include <algorithm>
#include <cstddef>
#include <functional>

namespace trajlo {
namespace {

/// Lost, when the map grew with what was seen for this long, and still explains few of the points.
constexpr std::int64_t kFewPoints_ns = 1'000'000'000;
/// Or when of all windows of this time ...
constexpr std::int64_t kSpan_ns = 3'000'000'000;
/// (at least this many windows: a few scans, far apart, have no share) ...
constexpr std::size_t kFewestWindows = 20;
/// ... more than this share did not settle, or were reverted: planes that never settle are not
/// those of the scene. A fast turn to and fro leaves half of them unsettled, at the right place ...
constexpr double kMaxUnsettledShare = 0.8;
/// ... but where the poses have a flag that speaks against them, too, half is enough.
constexpr double kMaxDoubtfulShare = 0.5;
/// These do not: that the rounds ran out says no more than that a window is unsettled, and in a
/// direction that is left open the planes may be those of the scene.
constexpr unsigned kNoDoubt = kFlagNotConverged | kFlagDegenerate;

}  // namespace

std::optional<std::int64_t> LossWatch::Update(const WindowStatistics& window) {
  const bool few = TooFewInliers(window);
  const bool unsettled = TooFewSettled(window);
  if (few) return few_since_ns_;
  if (unsettled) return recent_.front().end_ns;
  return std::nullopt;
}

bool LossWatch::TooFewInliers(const WindowStatistics& window) {
  if (!window.HasFewInliers()) {
    few_since_ns_.reset();
    return false;
  }
  if (!few_since_ns_) few_since_ns_ = window.end_ns;
  return window.end_ns - *few_since_ns_ >= kFewPoints_ns;
}

bool LossWatch::TooFewSettled(const WindowStatistics& window) {
  const bool is_unsettled = (window.flags & kFlagReverted) != 0 || window.IsRestless();
  const bool is_doubtful = is_unsettled && (window.flags & ~kNoDoubt) != 0;
  recent_.push_back({window.end_ns, is_unsettled, is_doubtful});
  const std::int64_t begin_ns = window.end_ns - kSpan_ns;
  while (recent_.size() > kFewestWindows && recent_.front().end_ns < begin_ns) {
    recent_.pop_front();
    span_is_full_ = true;
  }
  return span_is_full_ && (Share(&Past::is_unsettled) > kMaxUnsettledShare ||
                           Share(&Past::is_doubtful) > kMaxDoubtfulShare);
}

double LossWatch::Share(bool Past::*what) const {
  const auto those = std::count_if(recent_.begin(), recent_.end(), std::mem_fn(what));
  return static_cast<double>(those) / static_cast<double>(recent_.size());
}

}  // namespace trajlo
