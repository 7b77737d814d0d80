// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/evaluation_callback.h>

#include <vector>

#include "core/odometry/solvers/pose_blocks.h"
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
  PrepareRegistration(const PoseBlocks* blocks, RegistrationEvaluator* evaluator)
      : blocks_(blocks), evaluator_(evaluator) {}

  /// A new solve begins; `window` must outlive it.
  void Begin(Window* window, int steps);

  void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override;

  /// Written anew at each evaluation; the address stays while the number of segments does.
  const RegistrationNormalEquations* equations(int k) const {
    return &equations_[static_cast<std::size_t>(k)];
  }
  void Resize(std::size_t segments) { equations_.resize(segments); }

  /// The registration at `poses`, where Ceres ended.
  const std::vector<RegistrationNormalEquations>& At(const std::vector<SE3>& poses);

 private:
  void ShiftTo(const std::vector<SE3>& poses);

  const PoseBlocks* blocks_;
  RegistrationEvaluator* evaluator_;
  Window* window_ = nullptr;
  bool linearize_steps_ = false;
  std::vector<RegistrationNormalEquations> equations_;
  /// The newest linearisation, and where.
  std::vector<RegistrationNormalEquations> linearized_;
  std::vector<SE3> linearized_at_;
};

}  // namespace trajlo
