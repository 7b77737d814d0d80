// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <vector>

#include "core/odometry/map/map_level.h"

namespace trajlo {

struct MapPyramidOptions {
  MapOptions finest;
  PlaneFitOptions plane;
  /// Number of maps, each with voxels and spacing twice those of the one before; 1 is the paper's
  /// single map.
  int levels = 4;
};

/// The plane normalᵀ x = offset in the world frame.
struct Plane {
  Eigen::Vector3d normal_world;
  double offset_m;
  /// Relative information of a distance to it, in (0, 1]; zero says that there is no plane.
  double weight = 0.0;
  /// Voxels of the level it comes from, in those of the finest.
  double scale = 1.0;

  bool exists() const { return weight > 0.0; }
};

/// The same points at several resolutions. Where a coarse map has a plane that is wide and thin (a
/// wall, a floor), that one is taken: the normal of a plane is as exact as it is wide, and a wide
/// one spans several scan lines. Elsewhere the finest map that has a plane answers, where points
/// are dense and planes small; where it has none (far away, on sparse rings, in a part of the world
/// just entered) the next coarser one, whose voxels reach farther.
class MapPyramid {
 public:
  static constexpr int kMaxLevels = 8;
  /// The most queries at a time.
  static constexpr std::size_t kMaxBatch = 64;

  /// Throws std::invalid_argument unless there are 1 to kMaxLevels levels.
  explicit MapPyramid(const MapPyramidOptions& options);

  void Insert(const std::vector<Eigen::Vector3d>& points_world);
  void RemoveFar(const Eigen::Vector3d& center_world);

  /// The planes at `count` <= kMaxBatch places. A ray is the unit vector from the sensor to the
  /// place: a plane that it merely grazes is taken only where there is no other. A plane that is
  /// not wide and thin has its weight divided by the ratio of its level.
  void FindPlanes(const Eigen::Vector3d* places_world, const Eigen::Vector3d* rays_world,
                  std::size_t count, Plane* planes) const;
  Plane FindPlane(const Eigen::Vector3d& place_world, const Eigen::Vector3d& ray_world) const;

  const VoxelHashMap& finest() const { return levels_.front().points(); }
  /// Points of all levels.
  std::size_t size() const;

 private:
  struct Candidate;
  struct Batch;
  void AskLevel(std::size_t level, Batch* batch) const;

  PlaneFitOptions plane_;
  std::deque<MapLevel> levels_;
};

}  // namespace trajlo
