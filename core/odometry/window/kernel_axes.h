// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "factors/registration_point.h"

namespace trajlo {

/// Notes in each point which of the axes (columns, see Window::kernel_axes) its normal is nearest
/// to.
inline void AssignAxes(const Eigen::Matrix3d& axes_world, std::vector<RegistrationPoint>* points) {
  for (RegistrationPoint& point : *points) {
    (axes_world.transpose() * point.normal_world).cwiseAbs().maxCoeff(&point.axis);
  }
}

}  // namespace trajlo
