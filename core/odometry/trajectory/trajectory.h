// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "manifolds/se3.h"

namespace trajlo {

/// T_world_body at an instant.
struct ControlPose {
  std::int64_t t_ns = 0;
  SE3 T_world_body;
  /// WindowFlag bits of the window in which it was the newest pose, and of what showed later; 0 is
  /// good.
  unsigned flags = 0;
};

/// A continuous-time trajectory: control poses and the constant twist between neighbours (paper
/// eq. 1), which can be asked at any time of the whole run.
class Trajectory {
 public:
  /// Times must increase; throws std::invalid_argument otherwise.
  void Append(const ControlPose& pose);

  /// T_world_body at t_ns by interpolation; empty outside [begin, end].
  std::optional<SE3> At(std::int64_t t_ns) const;

  const std::vector<ControlPose>& poses() const { return poses_; }
  bool empty() const { return poses_.empty(); }

 private:
  std::vector<ControlPose> poses_;
};

}  // namespace trajlo
