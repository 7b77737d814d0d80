// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/evaluation_callback.h>
#include <ceres/problem.h>

#include <array>
#include <vector>

#include "core/odometry/solvers/solver_options.h"
#include "core/odometry/solvers/window_problem.h"

namespace trajlo {

/// The control poses of a window as Ceres sees them: blocks of [qx qy qz qw tx ty tz].
class PoseBlocks {
 public:
  explicit PoseBlocks(const std::vector<SE3>& poses);

  double* block(int k) { return blocks_[static_cast<std::size_t>(k)].data(); }
  std::vector<SE3> Poses() const;
  void SetPoses(const std::vector<SE3>& poses);

 private:
  std::vector<std::array<double, 7>> blocks_;
};

/// Sees each point at which Ceres is about to evaluate the window. For the prepared form it
/// computes the registration of all segments there, in parallel, before Ceres asks the blocks for
/// it.
class PrepareRegistration final : public ceres::EvaluationCallback {
 public:
  PrepareRegistration(const WindowProblem* problem, const SolverOptions& options,
                      const PoseBlocks* blocks, RegistrationEvaluator* evaluator,
                      std::vector<RegistrationNormalEquations>* equations);

  void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override;

  /// Whether the last equations hold more than the cost.
  bool is_linearized() const { return is_linearized_; }
  /// The poses last evaluated, whether or not Ceres took the step to them.
  const std::vector<SE3>& evaluated_poses() const { return poses_; }
  const RegistrationNormalEquations* equations(int k) const { return &(*equations_)[k]; }

 private:
  const WindowProblem* problem_;
  const SolverOptions& options_;
  const PoseBlocks* blocks_;
  RegistrationEvaluator* evaluator_;
  std::vector<RegistrationNormalEquations>* equations_;
  std::vector<SE3> poses_;
  bool is_first_ = true;
  bool is_linearized_ = false;
};

/// Adds the registration of all segments in one of its forms; `prepare` is only read by the
/// prepared one. `loss` is the kernel for the forms with one block a point; it must outlive
/// `ceres_problem`.
void AddRegistration(const WindowProblem& problem, RegistrationForm form,
                     const PrepareRegistration& prepare, ceres::LossFunction* loss,
                     PoseBlocks* blocks, ceres::Problem* ceres_problem);

}  // namespace trajlo
