// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "core/odometry/map/map_point.h"
#include "core/odometry/map/neighbors.h"

namespace trajlo {

/// nanoflann's kd-tree over the points of a map: the k nearest of all of them, exactly. Also the
/// oracle of the hash of voxels, in tests.
class KdTreeIndex {
 public:
  KdTreeIndex();
  ~KdTreeIndex();

  void Add(const std::vector<MapPoint>& points);
  void Nearest(const Eigen::Vector3d& query_world, int k, Neighbors* neighbors) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

}  // namespace trajlo
