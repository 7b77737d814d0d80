// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/odometry/map/huge_page_allocator.h"
#include "core/odometry/map/map_point.h"
#include "core/odometry/map/neighbors.h"
#include "core/odometry/map/voxel_index.h"

namespace trajlo {

/// The paper's map: a hash of voxels with at most 20 points each; a query looks into the voxel of
/// the point and the six that share a face with it.
///
/// Every voxel that has points or shares a face with one that does knows how many points there are
/// around it. Where they are enough for a plane it is a site, and has a number. Queries are const
/// and may run on several threads; insertion and removal may not run at the same time.
class VoxelHashMap {
 public:
  /// The paper's bound.
  static constexpr int kMaxPointsPerVoxel = 20;
  /// Around a site, at least.
  static constexpr std::uint32_t kPointsOfSite = 5;

  /// A point nearer than `min_point_spacing_m` to another of its voxel is not added. Voxels farther
  /// than `radius_m` from the sensor are dropped.
  VoxelHashMap(double voxel_size_m, double min_point_spacing_m, double radius_m);

  /// Adds points in the given order, each if its voxel has room and no point too near. Returns
  /// those added.
  std::vector<MapPoint> Insert(const std::vector<MapPoint>& points);

  /// Removes from `points` what has no room: Insert() would not add it now, nor after others.
  void DropRefused(std::vector<MapPoint>* points) const;

  /// Drops what is farther than the radius from `center_world`. Appends to `changed` the numbers of
  /// all sites that lost points, once or more; those of voxels that are no longer sites may be
  /// given to others.
  void RemoveFar(const Eigen::Vector3d& center_world, std::vector<std::uint32_t>* changed);

  /// The `k` nearest points, 1 to kMaxNeighbors, of the seven voxels around `query_world`.
  void Nearest(const Eigen::Vector3d& query_world, int k, Neighbors* neighbors) const;

  const VoxelIndex& index() const { return index_; }
  /// The numbers of all sites are smaller.
  std::size_t site_capacity() const { return site_count_; }

  double min_point_spacing_m() const { return spacing_; }
  /// Number of points.
  std::size_t size() const { return point_count_; }
  void ForEachPoint(const std::function<void(const MapPoint&)>& visit) const;

 private:
  /// Up to four points of a voxel, relative to its corner: a cache line. Most voxels need one.
  /// Their coordinates hold from where they were seen, too: SeenFrom.
  struct alignas(64) Block {
    static constexpr int kCapacity = 4;
    float x[kCapacity] = {}, y[kCapacity] = {}, z[kCapacity] = {};
    VoxelKey key = VoxelKey::Zero();
    std::uint32_t next : 24;  ///< More points of the voxel.
    std::uint32_t count : 8;
    Block() : next(kNoNext), count(0) {}
  };
  static constexpr std::uint32_t kNoNext = (1U << 24) - 1;
  static_assert(sizeof(Block) == 64);
  struct Candidates;

  VoxelKey KeyOf(const Eigen::Vector3d& p) const { return VoxelAt(p, inverse_size_); }
  Eigen::Vector3d CornerOf(const VoxelKey& key) const { return voxel_size_ * key.cast<double>(); }
  /// Whether a voxel, given by its first block, is not full and has no point that is too near.
  bool HasRoomFor(std::uint32_t block, const Eigen::Vector3f& p) const;
  void Append(VoxelIndex::Slot slot, const VoxelKey& key, const Eigen::Vector3f& p,
              const SeenFrom& seen_from);
  std::uint32_t NewBlock(const VoxelKey& key);
  /// Counts one more point around a voxel.
  void AddAround(VoxelIndex::Entry* entry);
  void DropVoxel(const VoxelKey& key, std::vector<std::uint32_t>* changed);
  void Gather(std::uint32_t block, const Eigen::Vector3f& shift, const Eigen::Vector3f& query,
              Candidates* candidates) const;
  void TakeNearest(const Candidates& candidates, int wanted, Neighbors* neighbors) const;

  double voxel_size_, inverse_size_, spacing_, radius_;
  VoxelIndex index_;
  std::vector<Block, HugePageAllocator<Block>> blocks_;
  std::vector<std::uint32_t> free_blocks_, free_sites_;
  std::size_t site_count_ = 0;
  std::size_t point_count_ = 0;
  std::optional<Eigen::Vector3d> last_removal_center_;
};

}  // namespace trajlo
