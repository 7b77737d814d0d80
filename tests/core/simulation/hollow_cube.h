// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/simulation/scenes/scene.h"

namespace trajlo::simulation {

/// The world of the tests: a cube about the origin, seen from inside. Everything about it has a
/// formula.
constexpr double kCubeHalfSize = 5.0;

inline Scene MakeHollowCube() {
  TriangleMesh mesh;
  mesh.AddBox(Eigen::Vector3d::Constant(-kCubeHalfSize), Eigen::Vector3d::Constant(kCubeHalfSize),
              0.5);
  return Scene(std::move(mesh));
}

/// The distance from a point inside to the cube's surface along a unit direction.
inline double CubeRange(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  double range = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) continue;
    const double wall = direction[axis] > 0.0 ? kCubeHalfSize : -kCubeHalfSize;
    range = std::min(range, (wall - origin[axis]) / direction[axis]);
  }
  return range;
}

/// The distance of a point to the nearest face, negative inside.
inline double DistanceToCubeFace(const Eigen::Vector3d& p) {
  return p.cwiseAbs().maxCoeff() - kCubeHalfSize;
}

}  // namespace trajlo::simulation
