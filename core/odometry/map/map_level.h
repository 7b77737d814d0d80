// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "core/odometry/map/kd_tree_index.h"
#include "core/odometry/map/plane_cells.h"
#include "core/odometry/map/plane_fit.h"
#include "core/odometry/map/voxel_hash_map.h"
#include "core/options/describe.h"

namespace trajlo {

enum class MapKind { kVoxelHash, kKdTree };

struct MapOptions {
  MapKind kind = MapKind::kVoxelHash;
  double voxel_size_m = 0.3;
  double min_point_spacing_m = 0.12;
  double radius_m = 150.0;
  bool shared_planes = true;

  template <typename Describer>
  void Describe(Describer& d) {
    d(OptionFor::kExperts, "kind", kind,
      Names<MapKind>{{"voxel_hash", MapKind::kVoxelHash}, {"kd_tree", MapKind::kKdTree}},
      "voxel_hash is fast; kd_tree finds the exact neighbours, where the hash has five points "
      "around.");
    d(OptionFor::kUsers, "voxel_size_m", voxel_size_m, Range<double>{1e-2, 20.0},
      "Edge of a voxel (paper: 0.4 m indoors, 0.8 m outdoors).");
    d(OptionFor::kExperts, "min_point_spacing_m", min_point_spacing_m, Range<double>{0.0, 10.0},
      "A point nearer than this to another of its voxel is not added: otherwise a sensor at "
      "rest fills the voxels with copies of the same rings.");
    d(OptionFor::kUsers, "radius_m", radius_m, Range<double>{1.0, 1e4},
      "Voxels farther than this from the sensor are dropped, unless they are within its range "
      "(sensor.max_range_m).");
    d(OptionFor::kExperts, "shared_planes", shared_planes,
      "One plane for each eighth of a voxel, kept until there are more points around it; false "
      "fits one for every point, as the paper does.");
  }
};

/// One resolution of the map: points, and the planes through them.
class MapLevel {
 public:
  MapLevel(const MapOptions& options, const PlaneFitOptions& plane);

  /// See VoxelHashMap.
  std::vector<MapPoint> Insert(const std::vector<MapPoint>& points);
  void RemoveFar(const Eigen::Vector3d& center_world);

  /// An eighth of a voxel: floor(p / cell size). That of the next coarser level has half the
  /// coordinates.
  VoxelKey CellOf(const Eigen::Vector3d& p) const { return VoxelAt(p, inverse_cell_size_); }

  /// Whether a place is in a cell, or outside by at most a quarter of its edge.
  bool IsAround(const Eigen::Vector3d& p, const VoxelKey& cell) const {
    const Eigen::Array3d from_center =
        p.array() * inverse_cell_size_ - (cell.cast<double>().array() + 0.5);
    return from_center.abs().maxCoeff() <= 0.75;
  }

  /// The place that the planes of a cell refer to, if they are shared.
  Eigen::Vector3d CenterOf(const VoxelKey& cell) const {
    return cell_size_ * (cell.cast<double>().array() + 0.5);
  }

  /// Asking for a plane takes three steps. Many queries take each step together, which fetches
  /// ahead what the next one reads.
  VoxelIndex::Slot Locate(const VoxelKey& cell) const {
    const VoxelIndex::Slot slot = points_.index().Find(VoxelOf(cell));
    if (slot != VoxelIndex::kNoSlot) points_.index().Prefetch(slot);
    return slot;
  }
  /// What the index has there; null where no plane can be.
  const VoxelIndex::Entry* FindSite(VoxelIndex::Slot slot, const VoxelKey& cell) const {
    if (slot == VoxelIndex::kNoSlot) return nullptr;
    const VoxelIndex::Entry& entry = points_.index()[slot];
    if (entry.site == VoxelIndex::kNoSite) return nullptr;
    if (cells_) cells_->Prefetch(entry.site, CellInVoxel(cell));
    return &entry;
  }
  /// The plane of a cell, about `center_world`: CenterOf(cell), or any place if planes are not
  /// shared.
  FittedPlane PlaneAt(const VoxelIndex::Entry& site, const VoxelKey& cell,
                      const Eigen::Vector3d& center_world) const {
    if (!cells_) return Fit(center_world);
    return cells_->Get(site.site, CellInVoxel(cell), site.points_around,
                       [&] { return Fit(center_world); });
  }
  bool shares_planes() const { return cells_.has_value(); }

  const VoxelHashMap& points() const { return points_; }

 private:
  static VoxelKey VoxelOf(const VoxelKey& cell) {
    return {cell.x() >> 1, cell.y() >> 1, cell.z() >> 1};
  }
  /// Which of the eight.
  static std::uint32_t CellInVoxel(const VoxelKey& cell) {
    return static_cast<std::uint32_t>((cell.x() & 1) | (cell.y() & 1) << 1 | (cell.z() & 1) << 2);
  }
  FittedPlane Fit(const Eigen::Vector3d& center_world) const;

  PlaneFitOptions plane_;
  double cell_size_, inverse_cell_size_;
  VoxelHashMap points_;
  std::optional<KdTreeIndex> tree_;
  std::optional<PlaneCells> cells_;
};

}  // namespace trajlo
