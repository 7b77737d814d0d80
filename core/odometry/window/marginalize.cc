// SPDX-License-Identifier: MIT
#include "core/odometry/window/marginalize.h"

#include <algorithm>
#include <utility>

#include "core/odometry/window/window_equations.h"

namespace trajlo {
namespace {

/// How many poses, counted from the first, share a term with it.
int TouchedPoses(const Window& window) {
  const bool is_tied = window.size() > 1 && std::holds_alternative<WhiteNoiseAccelerationTerm>(
                                                window.segments[1].motion);
  return std::max(is_tied ? 3 : 2, window.prior.poses());
}

/// For the segment that becomes the oldest: what tied it to the one before is in the prior now,
/// unless that was a velocity taken as known.
void Untie(const Vector6d& velocity_before, Segment* segment) {
  if (auto* known = std::get_if<SmoothnessTerm>(&segment->motion)) {
    known->tau_expected = velocity_before * segment->Duration_s();
  } else {
    segment->motion = std::monostate();
  }
}

/// The prior of the window without its first control pose: that pose is eliminated from all terms
/// that touch it, at the state in which the window is left, so that the linear term needs no
/// correction.
MarginalizationPrior PriorWithoutFirstPose(const Window& window,
                                           const MarginalizationOptions& options) {
  const std::vector<SE3> poses = window.Poses();
  if (!options.enabled) return AnchorOf(poses[1]);
  const int touched = TouchedPoses(window);
  WindowNormalEquations terms;
  terms.SetZero(touched);
  const RegistrationNormalEquations& registration = window.segments.front().registration;
  terms.H.topLeftCorner<12, 12>() = registration.H;
  terms.g.head<12>() = registration.g;
  for (int k = 0; k < std::min(2, window.size()); ++k) {
    const LinearizedMotion motion = LinearizeMotion(window, poses, k);
    if (motion.count == 0 || motion.first > 0) continue;
    terms.Add(0, motion.jacobian.leftCols(6 * motion.count), motion.residual);
  }
  terms.Add(0, window.prior.Jacobian(poses), window.prior.Residual(poses));

  MarginalizationPrior prior =
      MarginalizeSchur(terms.H, terms.g, {poses.begin() + 1, poses.begin() + touched});
  prior.first_estimate_jacobians = options.first_estimate_jacobians;
  return prior;
}

}  // namespace

MarginalizationPrior AnchorOf(const SE3& T_world_first) {
  constexpr double kSigma_m = 1e-3, kSigma_rad = 1e-3;
  return MakeAnchor(T_world_first, kSigma_m, kSigma_rad);
}

Segment Marginalize(const MarginalizationOptions& options, Window* window) {
  window->prior = PriorWithoutFirstPose(*window, options);
  if (!window->is_believed) window->prior.offset.setZero();
  if (window->size() > 1) Untie(window->Velocity(0), &window->segments[1]);
  window->begin_velocity = window->Velocity(0);
  Segment oldest = std::move(window->segments.front());
  window->segments.erase(window->segments.begin());
  window->begin_ns = oldest.cloud.end_ns;
  window->T_world_begin = oldest.T_world_end;
  window->begin_flags = oldest.flags;
  return oldest;
}

}  // namespace trajlo
