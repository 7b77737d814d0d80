// SPDX-License-Identifier: MIT
#include "core/odometry/window/window_equations.h"

namespace trajlo {
namespace {

Vector6d MotionResidual(const Window& window, const std::vector<SE3>& poses, std::size_t k) {
  const MotionTerm& motion = window.segments[k].motion;
  if (const auto* known = std::get_if<SmoothnessTerm>(&motion)) {
    return known->Residual(poses[k], poses[k + 1]);
  }
  if (const auto* free = std::get_if<WhiteNoiseAccelerationTerm>(&motion)) {
    return free->Residual(poses[k - 1], poses[k], poses[k + 1]);
  }
  return Vector6d::Zero();
}

}  // namespace

WindowCost CostWithoutRegistration(const Window& window, const std::vector<SE3>& poses) {
  WindowCost cost;
  cost.prior = 0.5 * window.prior.Residual(poses).squaredNorm();
  for (std::size_t k = 0; k < window.segments.size(); ++k) {
    cost.motion += 0.5 * MotionResidual(window, poses, k).squaredNorm();
  }
  return cost;
}

LinearizedMotion LinearizeMotion(const Window& window, const std::vector<SE3>& poses, int k) {
  const auto i = static_cast<std::size_t>(k);
  const MotionTerm& motion = window.segments[i].motion;
  LinearizedMotion linearized = {0, 0, MotionResidual(window, poses, i),
                                 Eigen::Matrix<double, 6, 18>::Zero()};
  if (const auto* known = std::get_if<SmoothnessTerm>(&motion)) {
    linearized.first = k;
    linearized.count = 2;
    linearized.jacobian.leftCols<12>() = known->Jacobian(poses[i], poses[i + 1]);
  } else if (const auto* free = std::get_if<WhiteNoiseAccelerationTerm>(&motion)) {
    linearized.first = k - 1;
    linearized.count = 3;
    linearized.jacobian = free->Jacobian(poses[i - 1], poses[i], poses[i + 1]);
  }
  return linearized;
}

void AssembleWindow(const Window& window, const std::vector<SE3>& poses,
                    const std::vector<RegistrationNormalEquations>& registration,
                    WindowNormalEquations* equations) {
  const Eigen::Index size = 6 * static_cast<Eigen::Index>(poses.size());
  equations->H.setZero(size, size);
  equations->g.setZero(size);
  equations->cost = {};
  for (int k = 0; k < window.size(); ++k) {
    const RegistrationNormalEquations& segment = registration[static_cast<std::size_t>(k)];
    equations->H.block<12, 12>(6 * k, 6 * k) += segment.H;
    equations->g.segment<12>(6 * k) += segment.g;
    equations->cost.registration += segment.cost;

    const LinearizedMotion motion = LinearizeMotion(window, poses, k);
    if (motion.count == 0) continue;
    const auto J = motion.jacobian.leftCols(6 * motion.count);
    equations->H.block(6 * motion.first, 6 * motion.first, J.cols(), J.cols()).noalias() +=
        J.transpose() * J;
    equations->g.segment(6 * motion.first, J.cols()).noalias() += J.transpose() * motion.residual;
    equations->cost.motion += 0.5 * motion.residual.squaredNorm();
  }
  const Eigen::VectorXd r = window.prior.Residual(poses);
  const Eigen::MatrixXd J = window.prior.Jacobian(poses);
  equations->H.topLeftCorner(J.cols(), J.cols()).noalias() += J.transpose() * J;
  equations->g.head(J.cols()).noalias() += J.transpose() * r;
  equations->cost.prior = 0.5 * r.squaredNorm();
}

WindowNormalEquations AssembleWindow(const Window& window) {
  std::vector<RegistrationNormalEquations> registration;
  for (const Segment& segment : window.segments) registration.push_back(segment.registration);
  WindowNormalEquations equations;
  AssembleWindow(window, window.Poses(), registration, &equations);
  return equations;
}

}  // namespace trajlo
