// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "core/odometry/trajectory/final_poses.h"
#include "core/odometry/weights/motion_prior.h"
#include "core/odometry/window/interval_smoother.h"
#include "core/odometry/window/marginalize.h"
#include "core/odometry/window/window.h"

namespace trajlo {

/// The control poses that leave the window. They are final at once, unless it is in doubt where the
/// body is: then they wait until that is known, at most 5 s, and are estimated once more.
class LeavingPoses {
 public:
  /// Estimates a window from its poses on, as any other; nothing if that fails.
  using Estimate = std::function<std::optional<Window>(Window)>;

  /// `motion_prior` and `final_poses` must outlive it.
  LeavingPoses(const MarginalizationOptions& marginalization, const MotionPrior* motion_prior,
               FinalPoses* final_poses)
      : marginalization_(marginalization), motion_prior_(motion_prior), final_(final_poses) {}

  /// The first pose of `window` leaves.
  void Leave(const Window& window, const Matrix6d& covariance, bool is_in_doubt);
  /// The segment that left with it, which is needed if the pose waits.
  void AddSegment(Segment segment);
  /// In its place, where the window came to an end: the motion until `end_ns` was not measured.
  void AddGap(std::int64_t end_ns);

  /// The doubt is over in `newest`, the present window: what waits is estimated with it, and final.
  void SmoothBack(const Window& newest, const Estimate& estimate);
  /// What waits is final as it is.
  void Settle();

  /// From this time on, poses are flagged as lost. The first call counts.
  void Lose(std::int64_t t_ns) {
    if (!lost_at_ns_) lost_at_ns_ = t_ns;
  }
  const std::optional<std::int64_t>& lost_at_ns() const { return lost_at_ns_; }

 private:
  const MarginalizationOptions marginalization_;
  const MotionPrior* motion_prior_;
  FinalPoses* final_;
  IntervalSmoother waiting_;
  std::optional<std::int64_t> lost_at_ns_;
};

}  // namespace trajlo
