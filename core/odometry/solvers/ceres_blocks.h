// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/problem.h>

#include <vector>

#include "core/odometry/window/window.h"
#include "manifolds/se3_manifold.h"

namespace trajlo {

/// A Ceres problem over the control poses of a window, which are its parameter blocks. All that is
/// added must outlive it.
class CeresBlocks {
 public:
  /// `callback` may be null.
  CeresBlocks(std::vector<SE3>* poses, ceres::EvaluationCallback* callback);

  /// On the two poses of segment k, with `kernel` if there is one.
  void AddRegistration(ceres::CostFunction* factor, ceres::LossFunction* kernel, int k);
  void AddMotion(const MotionTerm& motion, int k);
  void AddPrior(const MarginalizationPrior& prior);

  ceres::Problem* problem() { return &problem_; }

 private:
  double* Block(int k) { return (*poses_)[static_cast<std::size_t>(k)].data(); }

  std::vector<SE3>* poses_;
  SE3Manifold manifold_;
  ceres::Problem problem_;
};

}  // namespace trajlo
