// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "core/odometry/map/seen_from.h"
#include "manifolds/eigen_abi.h"

namespace trajlo {

/// The most neighbours that a query can ask for.
constexpr int kMaxNeighbors = 20;

/// The points of the map nearest to a query, nearest first. Positions are single precision relative
/// to `origin_world`, which is near the query: precise however far from the world's origin.
struct Neighbors {
  Eigen::Vector3d origin_world = Eigen::Vector3d::Zero();
  int count = 0;
  float squared_distance[kMaxNeighbors];
  float x[kMaxNeighbors], y[kMaxNeighbors], z[kMaxNeighbors];
  SeenFrom seen_from[kMaxNeighbors];
};

}  // namespace trajlo
