// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "core/odometry/map/voxel_hash_map.h"

namespace trajlo {

/// The same points as VoxelHashMap (it decides what is added and what is dropped), searched by
/// nanoflann's kd-tree: the k nearest of the whole map, exactly. Slower to build; the oracle of the
/// hash, and a choice where voxels are too small for the sensor's sparsity.
class KdTreeMap final : public PointMap {
 public:
  explicit KdTreeMap(const MapOptions& options);
  ~KdTreeMap() override;

  void Insert(const std::vector<Eigen::Vector3d>& points_world,
              std::vector<Eigen::Vector3d>* accepted = nullptr) override;
  void RemoveFar(const Eigen::Vector3d& center_world) override;
  void Nearest(const Eigen::Vector3d& query_world, int k, int at_least,
               Neighbors* neighbors) const override;
  std::size_t size() const override { return store_.size(); }
  void ForEachPoint(const std::function<void(const Eigen::Vector3d&)>& visit) const override {
    store_.ForEachPoint(visit);
  }

 private:
  struct Index;
  void Rebuild();

  VoxelHashMap store_;
  std::unique_ptr<Index> index_;
};

}  // namespace trajlo
