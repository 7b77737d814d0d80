// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "core/odometry/trajectory/trajectory.h"

namespace trajlo {

/// A control pose that leaves the window, and the covariance of its right perturbation
/// [rho; theta] (m², m rad, rad²) there.
struct LeavingPose {
  ControlPose pose;
  Matrix6d covariance = Matrix6d::Zero();
};

/// The control poses that are final: a trajectory, and a callback that gets each of them once.
class FinalPoses {
 public:
  using Callback = std::function<void(const ControlPose&, const Matrix6d& covariance)>;

  void OnPose(Callback callback) { on_pose_ = std::move(callback); }
  /// Whether anybody asks for covariances.
  bool has_callback() const { return on_pose_ != nullptr; }

  /// The pose with which the map begins. It is final with the next one, and can be flagged or
  /// forgotten until then.
  void Begin(const ControlPose& first) { first_ = first; }
  void FlagFirst(unsigned flags) {
    if (first_) first_->flags |= flags;
  }
  void ForgetFirst() { first_.reset(); }

  void Append(const LeavingPose& pose);
  /// Calls back for all poses since the last time. The callback may throw.
  void HandOn();

  const Trajectory& trajectory() const { return trajectory_; }

 private:
  Trajectory trajectory_;
  std::optional<ControlPose> first_;
  std::deque<LeavingPose> to_hand_on_;
  Callback on_pose_;
};

}  // namespace trajlo
