// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/evaluation_callback.h>

#include <vector>

#include "core/odometry/window/registration_evaluator.h"

namespace trajlo {

/// Computes the registration of all segments, in parallel, at each point at which Ceres is about to
/// evaluate the window, before Ceres asks the blocks (PreparedRegistrationCost) for it.
///
/// Ceres asks for the cost of a step first and, when it has taken the step, for the Jacobians
/// there. Where another step follows in the same solve, both are computed together. After the last
/// step nobody needs Jacobians to more than first order: the registration is shifted by the step.
class PrepareRegistration final : public ceres::EvaluationCallback {
 public:
  /// `poses` are Ceres's parameter blocks. Both must outlive it.
  PrepareRegistration(const std::vector<SE3>* poses, RegistrationEvaluator* evaluator)
      : poses_(*poses), evaluator_(evaluator), equations_(poses->size() - 1) {}

  /// A new solve of at most `steps` begins; `window` must outlive it.
  void Begin(Window* window, int steps);

  void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override;

  /// Written anew at each evaluation; the address stays.
  const RegistrationNormalEquations* equations(int k) const {
    return &equations_[static_cast<std::size_t>(k)];
  }

  /// Leaves the registration around the window's poses, where Ceres ended, in its segments.
  void Finish();

 private:
  const std::vector<SE3>& poses_;
  RegistrationEvaluator* evaluator_;
  std::vector<RegistrationNormalEquations> equations_;
  Window* window_ = nullptr;
  bool has_many_steps_ = false;
  bool is_at_start_ = true;
};

}  // namespace trajlo
