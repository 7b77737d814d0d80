// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/export/scan_placer.h"
#include "core/odometry/map/voxel_index.h"

namespace trajlo {

/// A place on a surface.
struct Surfel {
  Eigen::Vector3d p_world_m = Eigen::Vector3d::Zero();
  float intensity = 0.0F;
  std::int64_t seen_ns = 0;  ///< When it was first measured.
  /// A unit vector to the side from which it was first seen; zero where there are too few
  /// neighbours.
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  /// Smallest eigenvalue of the neighbours' covariance over the sum of all: 0 is a plane, 1/3 a
  /// ball.
  float curvature = 0.0F;
};

/// The map of a whole run: one surfel for each voxel, at the mean of the points in it. The method's
/// own map forgets what is far away and knows no intensity.
class SurfaceMap {
 public:
  explicit SurfaceMap(double voxel_m) : voxel_m_(voxel_m) {}

  void Add(const PlacedScan& scan);
  std::size_t size() const { return cells_.size(); }

  /// In the order in which they were first seen. Normals are those of the twelve nearest (principal
  /// component analysis), within five voxels.
  std::vector<Surfel> Surfels() const;

 private:
  struct Cell {
    Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
    double sum_intensity = 0.0;
    std::uint32_t points = 0;
    std::int64_t seen_ns = 0;
    Eigen::Vector3f seen_from_m = Eigen::Vector3f::Zero();
  };

  double voxel_m_;
  VoxelIndex index_;
  std::vector<Cell> cells_;
};

}  // namespace trajlo
