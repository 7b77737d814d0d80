// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "core/odometry/segments/segment_cloud.h"
#include "core/odometry/segments/voxel_filter.h"

namespace trajlo {

/// Chooses which points of a segment enter the map, and which of these are registered: one in each
/// cell of a grid, the first.
///
/// A grid suits a scene of some size. In a stairwell all points are near, and 0.03 s of them hit 80
/// cells of 0.4 m, which hold a pose poorly. So where few cells are hit, they are half as large.
/// They must have been few for some time: the next ones may be few because a hand is before the
/// LiDAR, which needs no closer look.
class SegmentThinner {
 public:
  /// Edges of the cells, and the most points that are registered; 0 takes all.
  SegmentThinner(double map_voxel_m, double registration_voxel_m, std::size_t max_points)
      : map_filter_(map_voxel_m),
        filter_(registration_voxel_m),
        fine_filter_(0.5 * registration_voxel_m),
        max_points_(max_points) {}

  /// Fills in the points of `cloud`, whose times are known. Segments come in order.
  void Thin(const std::vector<SegmentPoint>& points, SegmentCloud* cloud);

 private:
  VoxelFilter map_filter_, filter_, fine_filter_;
  std::size_t max_points_;
  /// The most cells that a segment hit lately; older ones count for less.
  double usual_cells_ = 0.0;
};

}  // namespace trajlo
