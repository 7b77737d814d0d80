// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "core/odometry/map/map_level.h"
#include "core/options/describe.h"

namespace trajlo {

struct MapPyramidOptions {
  MapOptions finest;
  PlaneFitOptions plane;
  int levels = 4;
  static constexpr int kMaxLevels = 8;

  template <typename Describer>
  void Describe(Describer& d) {
    finest.Describe(d);
    d(OptionFor::kExperts, "levels", levels, Range<int>{1, kMaxLevels},
      "Maps of growing coarseness, each with voxels and spacing twice those of the one before.");
  }
};

/// A place in the world, and the ray that ends there: from the sensor, of any length.
struct PlaneQuery {
  Eigen::Vector3d place_world;
  Eigen::Vector3f ray_world;
};

/// The plane normalᵀ x = offset in the world frame.
struct Plane {
  Eigen::Vector3d normal_world;
  double offset_m;
  /// Relative information of a distance to it, in (0, 1]; zero says that there is no plane.
  double weight = 0.0;
  /// The voxel size of its level as a multiple of the finest; 1 for a wide and thin plane. The
  /// weight is divided by its fourth power: a surface that is not flat departs from its plane by
  /// the square of the plane's size.
  double coarseness = 1.0;
  /// See FittedPlane; infinite where the ray merely grazes the plane, which may be no surface.
  double normal_variance_rad2 = 0.0;

  bool exists() const { return weight > 0.0; }
};

/// The same points at several resolutions. Where a coarse map has a plane that is wide and thin (a
/// wall, a floor), that one is taken: the normal of a plane is as exact as it is wide, and a wide
/// one spans several scan lines. Elsewhere the finest map that has a plane answers, where points
/// are dense and planes small; where it has none (far away, on sparse rings, in a part of the world
/// just entered) the next coarser one, whose voxels reach farther.
///
/// But a finer plane is taken only if it is thinner. The shape of a surface makes planes the
/// thinner, the smaller they are; noise does not. Where points scatter as far as a voxel, every
/// place has a plane of its own, which passes through wherever one asks: such planes would hold the
/// sensor where it is.
class MapPyramid {
 public:
  /// The most queries at a time.
  static constexpr std::size_t kMaxBatch = 64;

  /// Throws std::invalid_argument unless there are 1 to MapPyramidOptions::kMaxLevels levels.
  explicit MapPyramid(const MapPyramidOptions& options);

  void Insert(const std::vector<MapPoint>& points);
  /// Removes from `points` what Insert() would not add anyway.
  void DropRefused(std::vector<MapPoint>* points) const {
    levels_.front().points().DropRefused(points);
  }
  /// How far points lie from their planes (a standard deviation), as far as that is known. Planes
  /// that are hardly wider are noise: FindPlanes() takes a coarser one, or none. Those that are
  /// hardly thicker have full weight.
  void SetScatter(double scatter_m) { scatter_m_ = scatter_m; }
  void RemoveFar(const Eigen::Vector3d& center_world);

  /// Within a cell of the finest level, all levels have the same planes, if they are shared.
  VoxelKey CellOf(const Eigen::Vector3d& place_world) const {
    return levels_.front().CellOf(place_world);
  }
  /// Whether a place is in a cell of the finest level, or just outside it.
  bool IsAround(const Eigen::Vector3d& place_world, const VoxelKey& cell) const {
    return levels_.front().IsAround(place_world, cell);
  }
  /// How many points the finest level has been given so far; without a new one, nothing is new.
  std::int64_t inserted() const { return inserted_; }
  /// The planes at `count` <= kMaxBatch places. One that the ray from the sensor merely grazes is
  /// taken only where there is no other, and none that is only known from its other side.
  void FindPlanes(const PlaneQuery* queries, std::size_t count, Plane* planes) const;

  const VoxelHashMap& finest() const { return levels_.front().points(); }

 private:
  struct Batch;
  void AskLevel(int level, Batch* batch) const;
  bool IsGrazed(const FittedPlane& plane, const Eigen::Vector3f& ray_world) const;
  bool IsWideAndThin(const FittedPlane& plane) const;
  double WeightOf(const FittedPlane& plane, double coarseness) const;

  PlaneFitOptions plane_;
  std::int64_t inserted_ = 0;
  double scatter_m_ = 0.0;
  std::deque<MapLevel> levels_;
};

}  // namespace trajlo
