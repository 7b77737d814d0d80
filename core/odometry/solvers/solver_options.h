// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/window/step_size.h"
#include "core/options/describe.h"

namespace trajlo {

enum class SolverKind { kCeres, kGaussNewton };

struct SolverOptions {
  SolverKind kind = SolverKind::kCeres;
  int max_rounds = 20;
  int iterations_per_round = 1;
  /// Control poses that moved by less are where they were: planes and linearisations are kept, and
  /// rounds end where the next step would be smaller. What is left to go is a fraction of the last
  /// step, and the windows that follow solve for the same poses again.
  StepSize step_tolerance = {5e-3, 1e-3};

  template <typename Describer>
  void Describe(Describer& d) {
    d(OptionFor::kUsers, "kind", kind,
      Names<SolverKind>{{"ceres", SolverKind::kCeres}, {"gauss_newton", SolverKind::kGaussNewton}},
      "Ceres, or the hand-written Gauss-Newton of the paper.");
    d(OptionFor::kExperts, "max_rounds", max_rounds, Range<int>{1, 1000},
      "At most this many rounds of association and solve a window. Most windows take two to "
      "five; the first ones of a jerk, more.");
    d(OptionFor::kExperts, "iterations_per_round", iterations_per_round, Range<int>{1, 1000},
      "At most this many solver iterations in each round.");
    d(OptionFor::kExperts, "step_tolerance_m", step_tolerance.translation_m,
      Range<double>{0.0, 1.0},
      "The rounds end when no control pose would move by more than this in the next one, nor turn "
      "by more than step_tolerance_rad. Planes and linearisations are kept where poses moved "
      "less.");
    d(OptionFor::kExperts, "step_tolerance_rad", step_tolerance.rotation_rad,
      Range<double>{0.0, 1.0}, "See step_tolerance_m.");
  }
};

}  // namespace trajlo
