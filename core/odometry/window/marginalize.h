// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/window/window.h"
#include "core/options/describe.h"

namespace trajlo {

struct MarginalizationOptions {
  bool enabled = true;
  bool first_estimate_jacobians = false;

  template <typename Describer>
  void Describe(Describer& d) {
    d(OptionFor::kExperts, "enabled", enabled,
      "false forgets what leaves the window; the first pose that stays is held as the first pose "
      "of a recording is.");
    d(OptionFor::kExperts, "first_estimate_jacobians", first_estimate_jacobians,
      "Keeps the Jacobian of the prior as it was when the poses left.");
  }
};

/// Holds the first control pose of a recording.
MarginalizationPrior AnchorOf(const SE3& T_world_first);

/// Removes the oldest segment and returns it; its first pose lives on in the prior. The poses of a
/// window that is not believed are no minimum: what is left of their gradient would pull at the
/// windows that follow, and is dropped.
Segment Marginalize(const MarginalizationOptions& options, Window* window);

}  // namespace trajlo
