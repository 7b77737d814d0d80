// SPDX-License-Identifier: MIT
#include "core/odometry/solvers/prepare_registration.h"

#include <algorithm>

namespace trajlo {

void PrepareRegistration::Begin(Window* window, int steps) {
  window_ = window;
  linearize_steps_ = steps > 1;
  linearized_at_.clear();
}

void PrepareRegistration::PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) {
  const std::vector<SE3> poses = blocks_->Poses();
  if (new_evaluation_point && (linearize_steps_ || linearized_at_.empty())) {
    evaluator_->Evaluate(window_, poses, true, &linearized_);
    linearized_at_ = poses;
    std::copy(linearized_.begin(), linearized_.end(), equations_.begin());
    return;
  }
  if (new_evaluation_point) {
    std::vector<RegistrationNormalEquations> costs;
    evaluator_->Evaluate(window_, poses, false, &costs);
    std::copy(costs.begin(), costs.end(), equations_.begin());
  }
  if (evaluate_jacobians) ShiftTo(poses);
}

/// The cost stays as it was evaluated.
void PrepareRegistration::ShiftTo(const std::vector<SE3>& poses) {
  Eigen::VectorXd xi(6 * static_cast<Eigen::Index>(poses.size()));
  for (std::size_t k = 0; k < poses.size(); ++k) {
    xi.segment<6>(6 * static_cast<Eigen::Index>(k)) = Minus(poses[k], linearized_at_[k]);
  }
  std::vector<RegistrationNormalEquations> shifted = linearized_;
  ShiftRegistration(xi, &shifted);
  for (std::size_t k = 0; k < shifted.size(); ++k) {
    equations_[k].H = shifted[k].H;
    equations_[k].g = shifted[k].g;
  }
}

const std::vector<RegistrationNormalEquations>& PrepareRegistration::At(
    const std::vector<SE3>& poses) {
  ShiftTo(poses);
  return equations_;
}

}  // namespace trajlo
