// SPDX-License-Identifier: MIT
#include "core/odometry/health/loss_watch.h"

namespace trajlo {
namespace {

/// Lost, when of all windows of this time ...
constexpr double kSpan_s = 3.0;
/// ... more than this share did not settle, or were reverted: planes that never settle are not
/// those of the scene. A fast turn to and fro leaves half of them unsettled, at the right place.
constexpr double kMaxUnsettledShare = 0.8;

std::int64_t Nanoseconds(double s) { return static_cast<std::int64_t>(s * 1e9); }

}  // namespace

std::optional<std::int64_t> LossWatch::Update(const WindowStatistics& window) {
  const bool few = TooFewInliers(window);
  const bool unsettled = TooFewSettled(window);
  if (few) return few_since_ns_;
  if (unsettled) return recent_.front().end_ns;
  return std::nullopt;
}

bool LossWatch::TooFewInliers(const WindowStatistics& window) {
  if (window.InlierShare() >= options_.min_inlier_share) {
    few_since_ns_.reset();
    return false;
  }
  if (!few_since_ns_) few_since_ns_ = window.end_ns;
  return window.end_ns - *few_since_ns_ >= Nanoseconds(options_.max_duration_s);
}

bool LossWatch::TooFewSettled(const WindowStatistics& window) {
  const bool is_settled = (window.flags & kFlagReverted) == 0 && !window.IsRestless();
  recent_.push_back({window.end_ns, is_settled});
  unsettled_ += is_settled ? 0 : 1;
  const std::int64_t begin_ns = window.end_ns - Nanoseconds(kSpan_s);
  while (recent_.front().end_ns < begin_ns) {
    unsettled_ -= recent_.front().is_settled ? 0 : 1;
    recent_.pop_front();
    span_is_full_ = true;
  }
  return span_is_full_ &&
         static_cast<double>(unsettled_) > kMaxUnsettledShare * static_cast<double>(recent_.size());
}

}  // namespace trajlo
