// SPDX-License-Identifier: MIT
#pragma once

namespace trajlo {

enum class SolverKind { kCeres, kGaussNewton };

struct SolverOptions {
  SolverKind kind = SolverKind::kCeres;
  /// At most this many associate ↔ solve rounds a window.
  int max_rounds = 8;
  /// At most this many solver steps in each round.
  int iterations_per_round = 1;
  /// The rounds end when no control pose moved by more than these.
  double step_tolerance_m = 1e-3;
  double step_tolerance_rad = 1e-4;
};

}  // namespace trajlo
