// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>

#include "manifolds/eigen_abi.h"

namespace trajlo {

/// Where up is, from how a body was carried: whatever the mounting, most bodies turn about the
/// vertical far more than they tilt. So the direction of the world that stays most nearly the same
/// in the body frame is the vertical; while nothing has turned yet, it is z of the first pose.
class MeanAttitude {
 public:
  void Add(const Eigen::Quaterniond& q_world_body);

  Eigen::Vector3d VerticalInWorld() const;
  /// `q_world_body` with the tilt taken off that it has more than the mean.
  Eigen::Quaterniond Levelled(const Eigen::Quaterniond& q_world_body) const;

 private:
  Eigen::Matrix3d sum_ = Eigen::Matrix3d::Zero();
  double count_ = 0.0;
};

}  // namespace trajlo
