// SPDX-License-Identifier: MIT
#include "core/odometry/window_estimator.h"

#include "core/odometry/health/agreement.h"
#include "core/odometry/health/support.h"
#include "core/odometry/weights/fit_kernel.h"
#include "core/odometry/weights/graduated_kernel.h"
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
      s->has_converged = false;
    }
    s->milliseconds_solve += watch.Milliseconds();
  }
  s->agreement = AgreementOf(*window, *newest).worst;
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
