// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "core/odometry/map/plane_fit.h"
#include "core/odometry/map/point_map.h"

namespace trajlo {

struct MapPyramidOptions {
  MapOptions finest;
  /// Number of maps; 1 is the paper's single map.
  int levels = 4;
  /// Voxels and spacing grow by this from level to level.
  double level_ratio = 2.0;
};

/// The same points at several resolutions. Where a coarse map has a plane that is wide and thin (a
/// wall, a floor), that one is taken: the normal of a plane is as exact as it is wide, and a wide
/// one spans several scan lines. Elsewhere the finest map that has a plane answers, where points
/// are dense and planes small; where it has none (far away, on sparse rings, in a part of the world
/// just entered) the next coarser one, whose voxels reach farther.
class MapPyramid {
 public:
  static constexpr int kMaxLevels = 8;

  /// Throws std::invalid_argument unless there are 1 to kMaxLevels levels.
  explicit MapPyramid(const MapPyramidOptions& options);

  void Insert(const std::vector<Eigen::Vector3d>& points_world);
  void RemoveFar(const Eigen::Vector3d& center_world);

  /// The plane at `query_world`; its nearest point is within `reach_m` times the level's ratio.
  /// `ray_world` is the unit vector from the sensor to the query: a plane that it merely grazes is
  /// taken only where there is no other. A plane that is not wide and thin has its weight divided
  /// by the level's ratio.
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
  static bool FitAt(const Level& level, const Eigen::Vector3d& query_world,
                    const PlaneFitOptions& options, double reach_m, Plane* plane);
  std::vector<Level> levels_;
};

}  // namespace trajlo
