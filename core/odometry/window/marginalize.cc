// SPDX-License-Identifier: MIT
#include "core/odometry/window/marginalize.h"

#include <algorithm>
#include <utility>

#include "core/odometry/window/window_equations.h"
#include "factors/square_root.h"

namespace trajlo {
namespace {

/// The terms that touch the first pose, as stacked rows over [leaving; staying].
struct Rows {
  Eigen::MatrixXd J;
  Eigen::VectorXd r;
  Eigen::Index filled = 0;

  Rows(Eigen::Index most, Eigen::Index columns)
      : J(Eigen::MatrixXd::Zero(most, columns)), r(Eigen::VectorXd::Zero(most)) {}

  template <typename Jacobian, typename Residual>
  void Add(Eigen::Index first_column, const Jacobian& jacobian, const Residual& residual) {
    J.block(filled, first_column, jacobian.rows(), jacobian.cols()) = jacobian;
    r.segment(filled, residual.size()) = residual;
    filled += residual.size();
  }
};

/// How many poses, counted from the first, share a term with it.
int TouchedPoses(const Window& window) {
  const bool is_tied = window.size() > 1 && std::holds_alternative<WhiteNoiseAccelerationTerm>(
                                                window.segments[1].motion);
  return std::max(is_tied ? 3 : 2, window.prior.poses());
}

/// The segment that becomes the oldest: what tied it to the one before is in the prior now, unless
/// it was a velocity taken for known.
void Untie(const Vector6d& velocity_before, Segment* segment) {
  if (auto* known = std::get_if<SmoothnessTerm>(&segment->motion)) {
    known->tau_expected = velocity_before * segment->Duration_s();
  } else {
    segment->motion = std::monostate();
  }
}

}  // namespace

MarginalizationPrior AnchorOf(const SE3& T_world_first) {
  constexpr double kSigma_m = 1e-3, kSigma_rad = 1e-3;
  return MakeAnchor(T_world_first, kSigma_m, kSigma_rad);
}

MarginalizationPrior PriorWithoutFirstPose(const Window& window,
                                           const MarginalizationOptions& options) {
  const std::vector<SE3> poses = window.Poses();
  if (!options.enabled) {
    return AnchorOf(poses[1]);
  }
  const int touched = TouchedPoses(window);
  Rows rows(12 + 2 * 6 + 6 * window.prior.poses(), 6 * touched);
  const RegistrationNormalEquations& registration = window.segments.front().registration;
  const SquareRoot<12> root = MakeSquareRoot<12>(registration.H, registration.g);
  rows.Add(0, root.S, root.s);
  for (int k = 0; k < std::min(2, window.size()); ++k) {
    const LinearizedMotion motion = LinearizeMotion(window, poses, k);
    if (motion.count == 0 || motion.first > 0) continue;
    rows.Add(0, motion.jacobian.leftCols(6 * motion.count), motion.residual);
  }
  rows.Add(0, window.prior.Jacobian(poses), window.prior.Residual(poses));

  const std::vector<SE3> staying(poses.begin() + 1, poses.begin() + touched);
  MarginalizationPrior prior =
      options.use_qr
          ? MarginalizeQr(rows.J, rows.r, staying)
          : MarginalizeSchur(rows.J.transpose() * rows.J, rows.J.transpose() * rows.r, staying);
  prior.first_estimate_jacobians = options.first_estimate_jacobians;
  return prior;
}

Segment Marginalize(const MarginalizationOptions& options, Window* window) {
  window->prior = PriorWithoutFirstPose(*window, options);
  if (!window->is_believed) window->prior.offset.setZero();
  if (window->size() > 1) Untie(window->Velocity(0), &window->segments[1]);
  window->begin_velocity = window->Velocity(0);
  Segment oldest = std::move(window->segments.front());
  window->segments.erase(window->segments.begin());
  window->begin_ns = oldest.cloud.end_ns;
  window->T_world_begin = oldest.T_world_end;
  window->begin_flags = oldest.flags;
  return oldest;
}

}  // namespace trajlo
