// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "core/map/plane_fit.h"
#include "core/map/point_map.h"

namespace trajlo {

struct MapPyramidOptions {
  MapOptions finest;
  /// Number of maps; 1 is the paper's single map.
  int levels = 4;
  /// Voxels and spacing grow by this from level to level.
  double level_ratio = 2.0;
};

/// The same points at several resolutions. A plane is sought in the finest map first, where points
/// are dense and planes are small and exact; where it has none (far away, on sparse rings, in a
/// part of the world just entered) the next coarser map answers, whose voxels reach farther.
class MapPyramid {
 public:
  explicit MapPyramid(const MapPyramidOptions& options);

  void Insert(const std::vector<Eigen::Vector3d>& points_world);
  void RemoveFar(const Eigen::Vector3d& center_world);

  /// The plane at `query_world` from the finest level that has one whose nearest point is within
  /// `reach_m` times the level's ratio, and which `ray_world`, the unit vector from the sensor to
  /// the query, does not merely graze; its weight is divided by that ratio.
  bool FindPlane(const Eigen::Vector3d& query_world, const Eigen::Vector3d& ray_world,
                 const PlaneFitOptions& options, double reach_m, Plane* plane) const;

  const PointMap& finest() const { return *levels_.front().map; }
  /// Voxels of the coarsest level in those of the finest.
  double coarsest_scale() const { return levels_.back().scale; }
  /// Points of all levels.
  std::size_t size() const;

 private:
  struct Level {
    std::unique_ptr<PointMap> map;
    double scale;
    double spacing_m;
  };
  std::vector<Level> levels_;
};

}  // namespace trajlo
