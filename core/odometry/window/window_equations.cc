// SPDX-License-Identifier: MIT
#include "core/odometry/window/window_equations.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <limits>

namespace trajlo {

void WindowNormalEquations::Add(int first, const Eigen::Ref<const Eigen::MatrixXd>& J,
                                const Eigen::Ref<const Eigen::VectorXd>& r) {
  H.block(6 * first, 6 * first, J.cols(), J.cols()).noalias() += J.transpose() * J;
  g.segment(6 * first, J.cols()).noalias() += J.transpose() * r;
}

WindowCost CostWithoutRegistration(const Window& window, const std::vector<SE3>& poses) {
  WindowCost cost;
  cost.prior = 0.5 * window.prior.Residual(poses).squaredNorm();
  for (int k = 0; k < window.size(); ++k) {
    cost.motion += 0.5 * LinearizeMotion(window, poses, k).residual.squaredNorm();
  }
  return cost;
}

LinearizedMotion LinearizeMotion(const Window& window, const std::vector<SE3>& poses, int k) {
  const auto i = static_cast<std::size_t>(k);
  const MotionTerm& motion = window.segments[i].motion;
  LinearizedMotion linearized = {0, 0, Vector6d::Zero(), Eigen::Matrix<double, 6, 18>::Zero()};
  if (const auto* known = std::get_if<SmoothnessTerm>(&motion)) {
    linearized.first = k;
    linearized.count = 2;
    linearized.residual = known->Residual(poses[i], poses[i + 1]);
    linearized.jacobian.leftCols<12>() = known->Jacobian(poses[i], poses[i + 1]);
  } else if (const auto* free = std::get_if<WhiteNoiseAccelerationTerm>(&motion)) {
    linearized.first = k - 1;
    linearized.count = 3;
    linearized.residual = free->Residual(poses[i - 1], poses[i], poses[i + 1]);
    linearized.jacobian = free->Jacobian(poses[i - 1], poses[i], poses[i + 1]);
  }
  return linearized;
}

void AssembleWindow(const Window& window, const std::vector<SE3>& poses,
                    const std::vector<RegistrationNormalEquations>& registration,
                    WindowNormalEquations* equations) {
  equations->SetZero(static_cast<int>(poses.size()));
  for (int k = 0; k < window.size(); ++k) {
    const RegistrationNormalEquations& segment = registration[static_cast<std::size_t>(k)];
    equations->H.block<12, 12>(6 * k, 6 * k) += segment.H;
    equations->g.segment<12>(6 * k) += segment.g;
    equations->cost.registration += segment.cost;

    const LinearizedMotion motion = LinearizeMotion(window, poses, k);
    if (motion.count == 0) continue;
    equations->Add(motion.first, motion.jacobian.leftCols(6 * motion.count), motion.residual);
    equations->cost.motion += 0.5 * motion.residual.squaredNorm();
  }
  const Eigen::VectorXd r = window.prior.Residual(poses);
  equations->Add(0, window.prior.Jacobian(poses), r);
  equations->cost.prior = 0.5 * r.squaredNorm();
}

WindowNormalEquations AssembleWindow(const Window& window) {
  std::vector<RegistrationNormalEquations> registration;
  for (const Segment& segment : window.segments) registration.push_back(segment.registration);
  WindowNormalEquations equations;
  AssembleWindow(window, window.Poses(), registration, &equations);
  return equations;
}

Eigen::VectorXd SolveNormalEquations(const WindowNormalEquations& equations) {
  const Eigen::MatrixXd& H = equations.H;
  if (static_cast<std::size_t>(H.cols()) <= 6 * kLongWindow) return -H.ldlt().solve(equations.g);
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(H.sparseView());
  if (factor.info() != Eigen::Success) {
    return Eigen::VectorXd::Constant(H.cols(), std::numeric_limits<double>::quiet_NaN());
  }
  return -factor.solve(equations.g);
}

bool TakeStep(const Eigen::VectorXd& xi, std::vector<SE3>* poses) {
  if (!xi.allFinite()) return false;
  for (std::size_t k = 0; k < poses->size(); ++k) {
    (*poses)[k] = Plus((*poses)[k], xi.segment<6>(6 * static_cast<Eigen::Index>(k)));
  }
  return true;
}

}  // namespace trajlo
