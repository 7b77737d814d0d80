// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/odometry/window/window.h"

namespace trajlo {

/// The energy by factor: halves of squared residuals, robust where there is a kernel.
struct WindowCost {
  double registration = 0.0;
  double motion = 0.0;
  double prior = 0.0;
  double Total() const { return registration + motion + prior; }
};

/// The cost of motion and prior at `poses`.
WindowCost CostWithoutRegistration(const Window& window, const std::vector<SE3>& poses);

/// A motion term at a state: its residual and Jacobian over the poses first .. first + count - 1.
struct LinearizedMotion {
  int first = 0;
  int count = 0;  ///< 0: there is no term.
  Vector6d residual;
  Eigen::Matrix<double, 6, 18> jacobian;  ///< 6 columns a pose.
};
LinearizedMotion LinearizeMotion(const Window& window, const std::vector<SE3>& poses, int k);

/// The Hessian of a window with more poses than this is mostly zeros, as only neighbours share a
/// term: a sparse factorisation pays.
constexpr std::size_t kLongWindow = 16;

/// The normal equations of a window: H xi = -g with xi the stacked right perturbations of its
/// poses.
struct WindowNormalEquations {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  WindowCost cost;

  /// No terms yet.
  void SetZero(int poses) {
    H.setZero(6 * poses, 6 * poses);
    g.setZero(6 * poses);
    cost = {};
  }
  /// A term with residual r on the poses from `first` on.
  void Add(int first, const Eigen::Ref<const Eigen::MatrixXd>& J,
           const Eigen::Ref<const Eigen::VectorXd>& r);
};

/// The sum of prior, motion and registration at `poses`; `registration` has one entry a segment, at
/// the same poses.
void AssembleWindow(const Window& window, const std::vector<SE3>& poses,
                    const std::vector<RegistrationNormalEquations>& registration,
                    WindowNormalEquations* equations);

/// The same at the window's own poses, with the registration that its segments hold.
WindowNormalEquations AssembleWindow(const Window& window);

/// xi; not finite where H is singular.
Eigen::VectorXd SolveNormalEquations(const WindowNormalEquations& equations);

/// Moves the poses by the stacked right perturbations xi. False, and they stay, if that is not
/// finite.
bool TakeStep(const Eigen::VectorXd& xi, std::vector<SE3>* poses);

}  // namespace trajlo
