// SPDX-License-Identifier: MIT
#include "core/odometry/health/loss_watch.h"

#include <algorithm>

namespace trajlo {
namespace {

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
  const bool is_settled = (window.flags & (kFlagNotConverged | kFlagReverted)) == 0;
  recent_.push_back({window.end_ns, is_settled, window.threshold_m >= full_threshold_m_});
  unsettled_ += is_settled ? 0 : 1;
  full_threshold_ += recent_.back().has_full_threshold ? 1 : 0;
  const std::int64_t begin_ns = window.end_ns - Nanoseconds(options_.convergence_span_s);
  while (recent_.front().end_ns < begin_ns) {
    unsettled_ -= recent_.front().is_settled ? 0 : 1;
    full_threshold_ -= recent_.front().has_full_threshold ? 1 : 0;
    recent_.pop_front();
    span_is_full_ = true;
  }
  const double max_share = full_threshold_ == recent_.size()
                               ? std::min(options_.max_unconverged_share,
                                          options_.max_unconverged_share_at_full_threshold)
                               : options_.max_unconverged_share;
  const auto windows = static_cast<double>(recent_.size());
  return span_is_full_ && static_cast<double>(unsettled_) > max_share * windows;
}

}  // namespace trajlo
