// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/window/step_size.h"

namespace trajlo {

enum class SolverKind { kCeres, kGaussNewton };

struct SolverOptions {
  SolverKind kind = SolverKind::kCeres;
  /// At most this many associate ↔ solve rounds a window.
  int max_rounds = 8;
  /// At most this many solver steps in each round.
  int iterations_per_round = 1;
  /// The rounds end when no control pose moves by more.
  StepTolerance step_tolerance;
};

}  // namespace trajlo
