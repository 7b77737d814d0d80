// SPDX-License-Identifier: MIT
#include "core/odometry/health/loss_watch.h"

namespace trajlo {
namespace {

/// Lost, when of all windows of this time ...
constexpr double kSpan_s = 3.0;
/// ... more than this share did not settle, or were reverted: planes that never settle are not
/// those of the scene.
constexpr double kMaxUnsettledShare = 0.8;
/// Where predictions are off by kFailedPrediction_m (root mean square over the span), this share is
/// enough ...
constexpr double kMaxUnpredictedShare = 0.5;
constexpr double kFailedPrediction_m = 1.4;
/// ... a rotation counting with this lever arm.
constexpr double kLeverArm_m = 20.0;

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
  const double correction_m = window.correction_m + kLeverArm_m * window.correction_rad;
  recent_.push_back({window.end_ns, is_settled, correction_m * correction_m});
  unsettled_ += is_settled ? 0 : 1;
  const std::int64_t begin_ns = window.end_ns - Nanoseconds(kSpan_s);
  while (recent_.front().end_ns < begin_ns) {
    unsettled_ -= recent_.front().is_settled ? 0 : 1;
    recent_.pop_front();
    span_is_full_ = true;
  }
  const auto windows = static_cast<double>(recent_.size());
  double squared_corrections_m2 = 0.0;
  for (const Window& recent : recent_) squared_corrections_m2 += recent.squared_correction_m2;
  const bool predictions_fail =
      squared_corrections_m2 > kFailedPrediction_m * kFailedPrediction_m * windows;
  const double max_share = predictions_fail ? kMaxUnpredictedShare : kMaxUnsettledShare;
  return span_is_full_ && static_cast<double>(unsettled_) > max_share * windows;
}

}  // namespace trajlo
