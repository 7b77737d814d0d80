// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "manifolds/eigen_abi.h"

namespace trajlo {

/// A place on a surface, and from where it was seen.
struct MapPoint {
  Eigen::Vector3d place_world;
  /// From the place to the sensor, of any length; zero if that is not known.
  Eigen::Vector3f to_sensor_world = Eigen::Vector3f::Zero();
};

}  // namespace trajlo
