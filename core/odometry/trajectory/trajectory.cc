// SPDX-License-Identifier: MIT
#include "core/odometry/trajectory/trajectory.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "manifolds/se3_interpolation.h"

namespace trajlo {

void Trajectory::Append(const ControlPose& pose) {
  if (!poses_.empty() && pose.t_ns <= poses_.back().t_ns) {
    throw std::invalid_argument("Trajectory::Append: time " + std::to_string(pose.t_ns) +
                                " ns is not after " + std::to_string(poses_.back().t_ns) + " ns");
  }
  poses_.push_back(pose);
}

std::optional<SE3> Trajectory::At(std::int64_t t_ns) const {
  if (poses_.empty() || t_ns < poses_.front().t_ns || t_ns > poses_.back().t_ns) {
    return std::nullopt;
  }
  const auto end =
      std::lower_bound(poses_.begin(), poses_.end(), t_ns,
                       [](const ControlPose& pose, std::int64_t t) { return pose.t_ns < t; });
  if (end->t_ns == t_ns) return end->T_world_body;
  const ControlPose& begin = *(end - 1);
  const double alpha =
      static_cast<double>(t_ns - begin.t_ns) / static_cast<double>(end->t_ns - begin.t_ns);
  return Interpolate(begin.T_world_body, end->T_world_body, alpha);
}

}  // namespace trajlo
