// SPDX-License-Identifier: MIT
#pragma once

#include <tsl/robin_map.h>

#include <array>
#include <optional>

#include "core/odometry/map/point_map.h"

namespace trajlo {

/// The paper's map: a hash of voxels with a bounded number of points each; a query looks into the
/// voxel of the point and the six that share a face with it.
///
/// Points are stored in blocks (one a voxel, x then y then z, single precision relative to the
/// voxel's corner), so that the distances of a voxel are one short vector loop. Blocks know their
/// six neighbours: a query hashes once. A neighbour voxel is skipped when its face is farther than
/// the k-th point found so far, and nothing is looked up where a table of counts says that the
/// seven voxels hold too few points (most queries of a sensor in the open end there); neither
/// changes the answer. Voxel indices are floor(x / size) as 32-bit numbers: coordinates of 1e6 m
/// are fine.
class VoxelHashMap final : public PointMap {
 public:
  explicit VoxelHashMap(const MapOptions& options);

  void Insert(const std::vector<Eigen::Vector3d>& points_world,
              std::vector<Eigen::Vector3d>* accepted = nullptr) override;
  void RemoveFar(const Eigen::Vector3d& center_world) override;
  void Nearest(const Eigen::Vector3d& query_world, int k, int at_least,
               Neighbors* neighbors) const override;
  std::size_t size() const override { return point_count_; }
  void ForEachPoint(const std::function<void(const Eigen::Vector3d&)>& visit) const override;

  /// Adds one point; false when its voxel is full or it is too near to another point there.
  bool InsertPoint(const Eigen::Vector3d& point_world);
  std::size_t voxel_count() const { return index_.size(); }

 private:
  using Key = Eigen::Vector3i;
  struct KeyHash {
    std::size_t operator()(const Key& key) const;
  };
  struct Block {
    Key key = Key::Zero();
    int count = -1;  ///< -1: free.
    std::array<int, 6> neighbors{};
  };
  struct Best;

  Key KeyOf(const Eigen::Vector3d& p) const;
  Eigen::Vector3d Corner(const Key& key) const { return voxel_size_ * key.cast<double>(); }
  int Find(const Key& key) const;
  std::size_t SlotOf(const Key& key) const { return KeyHash()(key) & (counts_.size() - 1); }
  void AddToCounts(const Key& key, std::uint32_t points);
  void GrowCounts();
  int AddBlock(const Key& key);
  void FreeBlock(int block);
  const float* Points(int block) const { return coordinates_.data() + stride_ * block; }
  void Scan(int block, float dx, float dy, float dz, const float* query, Best* best) const;

  MapOptions options_;
  double voxel_size_;
  std::size_t stride_;  ///< Floats of a block: 3 times its capacity.
  tsl::robin_map<Key, int, KeyHash> index_;
  std::vector<Block> blocks_;
  /// By the hash of a voxel: how many points it and its six neighbours hold, or more (voxels that
  /// fall on the same entry add up). Its size is a power of two.
  std::vector<std::uint32_t> counts_;
  std::vector<float> coordinates_;
  std::vector<int> free_;
  std::size_t point_count_ = 0;
  std::optional<Eigen::Vector3d> last_removal_center_;
};

}  // namespace trajlo
