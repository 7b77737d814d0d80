// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "core/odometry/map/kd_tree_index.h"
#include "core/odometry/map/plane_cells.h"
#include "core/odometry/map/plane_fit.h"
#include "core/odometry/map/voxel_hash_map.h"

namespace trajlo {

enum class MapKind { kVoxelHash, kKdTree };

struct MapOptions {
  /// Which points are a place's nearest: those of the seven voxels around it, or of the whole map.
  MapKind kind = MapKind::kVoxelHash;
  /// Edge of a voxel (paper: 0.4 m indoors, 0.8 m outdoors).
  double voxel_size_m = 0.3;
  /// A point nearer than this to another of its voxel is not added: otherwise a sensor at rest
  /// fills the voxels with copies of the same rings, and planes are fitted to scan lines.
  double min_point_spacing_m = 0.12;
  /// Voxels farther than this from the sensor are dropped.
  double radius_m = 100.0;
  /// One plane for each eighth of a voxel, fitted about its centre and kept until the points around
  /// it have become more; otherwise every query fits its own, as in the paper.
  bool shared_planes = true;
};

/// One resolution of the map: points, and the planes through them.
class MapLevel {
 public:
  MapLevel(const MapOptions& options, const PlaneFitOptions& plane);

  /// See VoxelHashMap.
  void Insert(const std::vector<Eigen::Vector3d>& points_world,
              std::vector<Eigen::Vector3d>* accepted);
  void RemoveFar(const Eigen::Vector3d& center_world);

  /// An eighth of a voxel: floor(p / cell size). That of the next coarser level has half the
  /// coordinates.
  VoxelKey CellOf(const Eigen::Vector3d& p) const { return VoxelAt(p, inverse_cell_size_); }

  /// Asking for a plane takes three steps. Those of many queries go side by side, each step
  /// fetching ahead what the next one reads.
  void Prefetch(const VoxelKey& cell) const;
  /// What the index has there; null where no plane can be.
  const VoxelIndex::Entry* FindSite(const VoxelKey& cell) const;
  /// The plane in a cell for one who asks at `query_world`, and the center that it refers to.
  FittedPlane PlaneAt(const VoxelIndex::Entry& site, const VoxelKey& cell,
                      const Eigen::Vector3d& query_world, Eigen::Vector3d* center_world) const;

  const VoxelHashMap& points() const { return points_; }

 private:
  FittedPlane Fit(const Eigen::Vector3d& center_world) const;

  PlaneFitOptions plane_;
  double cell_size_, inverse_cell_size_;
  VoxelHashMap points_;
  std::optional<KdTreeIndex> tree_;
  std::optional<PlaneCells> cells_;
};

}  // namespace trajlo
