// SPDX-License-Identifier: MIT
#pragma once

#include "core/options/describe.h"

namespace trajlo {

struct InitializationOptions {
  double first_interval_s = 0.3;
  bool estimate_motion = true;

  template <typename Describer>
  void Describe(Describer& d) {
    d(OptionFor::kExperts, "first_interval_s", first_interval_s, Range<double>{1e-3, 10.0},
      "The motion at the start is estimated from this much of the recording, which also fills the "
      "map where it moves steadily (paper: 0.3 s).");
    d(OptionFor::kExperts, "estimate_motion", estimate_motion,
      "Estimates the motion during the first interval by registering its second half to its "
      "first one; false assumes a stationary start, as the paper does.");
  }
};

}  // namespace trajlo
