// SPDX-License-Identifier: MIT
#include "core/odometry/solvers/ceres_registration.h"

#include <ceres/autodiff_cost_function.h>

#include <algorithm>

#include "core/odometry/solvers/window_solver.h"
#include "factors/point_to_plane.h"
#include "factors/point_to_plane_autodiff.h"
#include "factors/segment_residuals.h"

namespace trajlo {

PoseBlocks::PoseBlocks(const std::vector<SE3>& poses) : blocks_(poses.size()) { SetPoses(poses); }

void PoseBlocks::SetPoses(const std::vector<SE3>& poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) std::copy_n(poses[i].data(), 7, blocks_[i].data());
}

std::vector<SE3> PoseBlocks::Poses() const {
  std::vector<SE3> poses;
  poses.reserve(blocks_.size());
  for (const auto& block : blocks_) poses.push_back(SE3::FromData(block.data()));
  return poses;
}

PrepareRegistration::PrepareRegistration(const WindowProblem* problem, const SolverOptions& options,
                                         const PoseBlocks* blocks, RegistrationEvaluator* evaluator,
                                         std::vector<RegistrationNormalEquations>* equations)
    : problem_(problem),
      options_(options),
      blocks_(blocks),
      evaluator_(evaluator),
      equations_(equations) {
  equations_->resize(problem->points.size());
}

/// Ceres asks for the cost of a step first and, as nearly every step is accepted, for the Jacobians
/// at the same point next: they are computed together. Jacobians at the point where the solve ends
/// serve marginalisation; only where each step is followed by new associations, unless it is so
/// small that it is the last one, nobody wants them, and the cost is enough.
void PrepareRegistration::PrepareForEvaluation(bool, bool new_evaluation_point) {
  if (!new_evaluation_point) return;
  poses_ = blocks_->Poses();
  if (options_.ceres.registration != RegistrationForm::kPrepared) return;
  is_linearized_ = is_first_ || options_.iterations_per_round > 1 ||
                   MeasureStep(problem_->poses, poses_).IsSmall(options_);
  is_first_ = false;
  evaluator_->Evaluate(*problem_, poses_, is_linearized_, equations_);
}

void AddRegistration(const WindowProblem& problem, RegistrationForm form,
                     const PrepareRegistration& prepare, ceres::LossFunction* loss,
                     PoseBlocks* blocks, ceres::Problem* ceres_problem) {
  const RegistrationNoise& noise = problem.noise;
  for (int k = 0; k < problem.segments(); ++k) {
    const std::vector<RegistrationPoint>& points = *problem.points[k];
    if (points.empty()) continue;
    const std::optional<SE3> linearized = problem.LinearizationPoint(k);
    const auto add = [&](ceres::CostFunction* factor, ceres::LossFunction* kernel) {
      ceres_problem->AddResidualBlock(factor, kernel, blocks->block(k), blocks->block(k + 1));
    };
    switch (form) {
      case RegistrationForm::kPrepared:
        add(new PreparedRegistrationCost(prepare.equations(k)), nullptr);
        break;
      case RegistrationForm::kCondensed:
        add(new SegmentRegistrationCost(&points, noise, linearized), nullptr);
        break;
      case RegistrationForm::kSegmentResiduals:
        add(new SegmentResidualsCost(&points, noise, linearized), nullptr);
        break;
      case RegistrationForm::kPoint:
        for (const RegistrationPoint& point : points) {
          add(new PointToPlaneCost(point, noise.sigma_m, linearized), loss);
        }
        break;
      case RegistrationForm::kPointAutodiff:
        for (const RegistrationPoint& point : points) {
          add(new ceres::AutoDiffCostFunction<PointToPlaneFunctor, 1, 7, 7>(
                  new PointToPlaneFunctor{point, noise.sigma_m}),
              loss);
        }
        break;
    }
  }
}

}  // namespace trajlo
