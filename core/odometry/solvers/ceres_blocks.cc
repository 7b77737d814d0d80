// SPDX-License-Identifier: MIT
#include "core/odometry/solvers/ceres_blocks.h"

namespace trajlo {
namespace {

ceres::Problem::Options ProblemOptions(ceres::EvaluationCallback* callback) {
  ceres::Problem::Options options;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.disable_all_safety_checks = true;
  options.evaluation_callback = callback;
  return options;
}

}  // namespace

CeresBlocks::CeresBlocks(std::vector<SE3>* poses, ceres::EvaluationCallback* callback)
    : poses_(poses), problem_(ProblemOptions(callback)) {
  for (SE3& pose : *poses) problem_.AddParameterBlock(pose.data(), 7, &manifold_);
}

void CeresBlocks::AddRegistration(ceres::CostFunction* factor, ceres::LossFunction* kernel, int k) {
  problem_.AddResidualBlock(factor, kernel, Block(k), Block(k + 1));
}

void CeresBlocks::AddMotion(const MotionTerm& motion, int k) {
  if (const auto* known = std::get_if<SmoothnessTerm>(&motion)) {
    problem_.AddResidualBlock(new SmoothnessCost(known), nullptr, Block(k), Block(k + 1));
  } else if (const auto* free = std::get_if<WhiteNoiseAccelerationTerm>(&motion)) {
    problem_.AddResidualBlock(new WhiteNoiseAccelerationCost(free), nullptr, Block(k - 1), Block(k),
                              Block(k + 1));
  }
}

void CeresBlocks::AddPrior(const MarginalizationPrior& prior) {
  std::vector<double*> poses;
  for (int k = 0; k < prior.poses(); ++k) poses.push_back(Block(k));
  problem_.AddResidualBlock(new MarginalizationPriorCost(&prior), nullptr, poses);
}

}  // namespace trajlo
