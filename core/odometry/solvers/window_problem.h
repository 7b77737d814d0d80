// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/odometry/parallel/parallel_for.h"
#include "factors/marginalization_prior.h"
#include "factors/segment_registration.h"
#include "factors/smoothness.h"

namespace trajlo {

/// One sliding-window problem with fixed associations (paper eq. 7): what both solvers are given.
///
///   E = sum_k registration_k(T_{k-1}, T_k) + sum_k smoothness_k(T_{k-1}, T_k) + prior(T_0)
///
/// `poses` (K+1 of them) is the start and receives the solution.
struct WindowProblem {
  std::vector<SE3> poses;
  std::vector<const std::vector<RegistrationPoint>*> points;  ///< One per segment.
  std::vector<SmoothnessTerm> smoothness;                     ///< One per segment.
  RegistrationNoise noise;
  MarginalizationPrior prior;
  /// The prior's pose has its Jacobians at the prior's linearisation point.
  bool first_estimate_jacobians = true;

  int segments() const { return static_cast<int>(points.size()); }
  /// The point at which segment k linearises its begin pose, where that is not the current state.
  std::optional<SE3> LinearizationPoint(int k) const {
    if (k == 0 && first_estimate_jacobians) return prior.linearization_point;
    return std::nullopt;
  }
};

/// The energy by factor: halves of squared residuals, robust where there is a kernel.
struct WindowCost {
  double registration = 0.0;
  double smoothness = 0.0;
  double prior = 0.0;
  double Total() const { return registration + smoothness + prior; }
};

/// The cost of smoothness and prior at `problem.poses`.
WindowCost CostWithoutRegistration(const WindowProblem& problem);

/// Evaluates the registration of all segments, in parallel over fixed chunks of points whose sums
/// are added in order: the same bits for any number of threads.
class RegistrationEvaluator {
 public:
  explicit RegistrationEvaluator(ThreadPool* threads) : threads_(threads) {}

  /// With `jacobians`, H, g and cost of every segment; without, only the cost.
  void Evaluate(const WindowProblem& problem, const std::vector<SE3>& poses, bool jacobians,
                std::vector<RegistrationNormalEquations>* equations);

 private:
  struct Chunk {
    int segment;
    std::size_t first, count;
    SegmentLinearizer::Sum sum;
  };
  ThreadPool* threads_;
  std::vector<Chunk> chunks_;
};

/// The whole normal equations of a window at `poses`: H xi = -g with xi the stacked right
/// perturbations, 6 (K+1) of them.
struct WindowNormalEquations {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  WindowCost cost;
};
void AssembleWindow(const WindowProblem& problem, const std::vector<SE3>& poses,
                    const std::vector<RegistrationNormalEquations>& registration,
                    WindowNormalEquations* window);

/// The covariance of the right perturbation [rho; theta] of the first pose, given all that the
/// window knows: that block of the inverse of H. It takes the map for exact and the points' errors
/// for independent, so it is optimistic. NaN where H is singular.
Matrix6d FirstPoseCovariance(const WindowNormalEquations& window);

/// Eliminates the first pose of the window at its current state (the state at which the window is
/// left, so the linear term needs no correction): the prior of the next window.
MarginalizationPrior MarginalizeOldest(const WindowProblem& problem,
                                       const RegistrationNormalEquations& first_segment,
                                       bool use_qr);

/// How the points of a window hold it: the information of a rigid motion of all control poses, in
/// the frame of the newest one, per point and unit sigma, rotations scaled to the same trace.
struct WindowCondition {
  double smallest_eigenvalue = 0.0;
  Vector6d weak_direction = Vector6d::Zero();  ///< [rho; theta], body frame, unit length.
};
WindowCondition ConditionOf(const WindowProblem& problem,
                            const std::vector<RegistrationNormalEquations>& registration);

}  // namespace trajlo
