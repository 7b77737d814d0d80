// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/odometry/parallel/parallel_for.h"
#include "core/odometry/window/window.h"

namespace trajlo {

/// Evaluates the registration of all segments, in parallel over fixed chunks of points whose sums
/// are added in order: the same bits for any number of threads.
class RegistrationEvaluator {
 public:
  explicit RegistrationEvaluator(ThreadPool* threads) : threads_(threads) {}

  /// H, g and cost of every segment at `poses`; without `jacobians` only the cost.
  void Evaluate(const Window& window, const std::vector<SE3>& poses, bool jacobians,
                std::vector<RegistrationNormalEquations>* equations);

 private:
  struct Chunk {
    std::size_t segment, first, count;
    SegmentLinearizer::Sum sum;
  };
  ThreadPool* threads_;
  std::vector<Chunk> chunks_;
};

/// The registration at `xi` away from where it was linearised, to first order and with the kernel's
/// weights of there: g + H xi, cost + gᵀxi + ½ xiᵀH xi. `xi` stacks the right perturbations of all
/// poses.
void ShiftRegistration(const Eigen::VectorXd& xi,
                       std::vector<RegistrationNormalEquations>* equations);

}  // namespace trajlo
