// SPDX-License-Identifier: MIT
#include "core/odometry/window_estimator.h"

#include <utility>

#include "core/odometry/health/agreement.h"
#include "core/odometry/health/support.h"
#include "core/odometry/weights/fit_kernel.h"
#include "core/odometry/weights/graduated_kernel.h"
#include "core/odometry/weights/innovation.h"
#include "core/odometry/window/associate_window.h"
#include "core/timing/stopwatch.h"

namespace trajlo {

void WindowEstimator::AssociateAndSolve(const MapPyramid& map, Window* window,
                                        WindowStatistics* s) {
  GraduatedKernel kernel(*window, registration_.kernel_m);
  Segment* newest = &window->segments.back();
  while (s->GoesOn(options_.max_rounds)) {
    Stopwatch watch;
    s->searched += AssociateWindow(map, options_.step_tolerance, threads_, window);
    if (s->rounds == 0) FitKernel(registration_, window);
    s->milliseconds_associate += watch.Milliseconds();
    const bool is_widened = kernel.Widen(newest);
    s->Add(solver_->Solve(window), options_);
    if (is_widened) {
      kernel.Restore(newest);
      ++s->widened_rounds;
      s->has_converged = false;
    }
    s->milliseconds_solve += watch.Milliseconds();
  }
  s->agreement = AgreementOf(*window, *newest).worst;
}

void WindowEstimator::Reassociate(const MapPyramid& map, const std::vector<SE3>& predicted,
                                  MotionPrior* motion_prior, Window* window, WindowStatistics* s) {
  Window first = *window;
  window->BeginAgainAt(predicted);
  Segment& newest = window->segments.back();
  newest.registration = {};
  newest.association = {};
  motion_prior->UntieRotation(window);
  WindowStatistics again;
  again.restless = s->restless;
  AssociateAndSolve(map, window, &again);
  const bool is_better = again.is_finite && again.agreement > s->agreement;
  if (is_better && !IsUnsupported(*window, newest)) {
    motion_prior->Apply(window);
    motion_prior->Follow(MeasureInnovation(*window, predicted.back()));
    motion_prior->Apply(window);
    std::swap(*s, again);
  } else {
    *window = std::move(first);
  }
  s->AddTimes(again);  // Both looks take time, whichever is kept.
}

void WindowEstimator::LeaveOutUnsupported(const std::vector<SE3>& predicted, Window* window,
                                          WindowStatistics* s) {
  if (!s->is_finite || !SilenceUnsupported(window)) return;
  Stopwatch watch;
  window->BeginAgainAt(predicted);
  const int last_round = s->rounds + options_.max_rounds;
  s->has_converged = false;
  while (s->GoesOn(last_round)) s->Add(solver_->Solve(window), options_);
  s->milliseconds_solve += watch.Milliseconds();
}

}  // namespace trajlo
