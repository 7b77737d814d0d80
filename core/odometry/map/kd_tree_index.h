// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "core/odometry/map/map_point.h"
#include "core/odometry/map/neighbors.h"

namespace trajlo {

/// nanoflann's kd-tree over the points of a map: the k nearest of all of them, exactly. Slower to
/// build than a hash of voxels; the oracle of the hash, and a choice for comparisons.
class KdTreeIndex {
 public:
  KdTreeIndex();
  ~KdTreeIndex();

  void Add(const std::vector<MapPoint>& points);
  void Clear();
  void Nearest(const Eigen::Vector3d& query_world, int k, Neighbors* neighbors) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

}  // namespace trajlo
