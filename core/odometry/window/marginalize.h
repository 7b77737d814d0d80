// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/window/window.h"

namespace trajlo {

struct MarginalizationOptions {
  /// Off: what leaves the window is forgotten, and its last pose is held by the anchor's sigmas.
  bool enabled = true;
  /// Keeps the Jacobian of the prior as it was where the poses left.
  bool first_estimate_jacobians = false;
  /// Orthogonal elimination instead of the Schur complement.
  bool use_qr = false;
  /// Standard deviations with which the first control pose of a recording is held.
  double anchor_sigma_translation_m = 1e-3;
  double anchor_sigma_rotation_rad = 1e-3;
};

/// The prior of the window without its first control pose: that pose is eliminated from all terms
/// that touch it, at the state in which the window is left, so that the linear term needs no
/// correction.
MarginalizationPrior PriorWithoutFirstPose(const Window& window,
                                           const MarginalizationOptions& options);

/// Removes the oldest segment and returns it; its first pose lives on in the prior. The poses of a
/// window that is not believed are no minimum: what is left of their gradient would pull at the
/// windows that follow, and is dropped.
Segment Marginalize(const MarginalizationOptions& options, Window* window);

}  // namespace trajlo
