// SPDX-License-Identifier: MIT
#include "core/odometry/solvers/prepare_registration.h"

namespace trajlo {

void PrepareRegistration::Begin(Window* window, int steps) {
  window_ = window;
  has_many_steps_ = steps > 1;
  is_at_start_ = true;
}

void PrepareRegistration::PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) {
  if (new_evaluation_point) {
    const bool linearize = has_many_steps_ || is_at_start_;
    is_at_start_ = false;
    evaluator_->Evaluate(window_, poses_, linearize, &equations_);
    if (linearize) return;
  }
  if (!evaluate_jacobians) return;
  for (std::size_t k = 0; k < equations_.size(); ++k) {
    // The cost stays as it was evaluated.
    const auto shifted = window_->segments[k].linearization->At(poses_[k], poses_[k + 1]);
    equations_[k].H = shifted.H;
    equations_[k].g = shifted.g;
  }
}

void PrepareRegistration::Finish() {
  // Of many steps the last one may have been rejected, and was linearised all the same.
  if (has_many_steps_) evaluator_->Evaluate(window_, window_->Poses(), true, &equations_);
  ShiftRegistration(window_);
}

}  // namespace trajlo
