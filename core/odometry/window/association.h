// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/odometry/map/map_pyramid.h"
#include "core/odometry/parallel/parallel_for.h"
#include "core/odometry/sensing/segment_cloud.h"
#include "core/odometry/window/step_size.h"
#include "factors/registration_point.h"
#include "manifolds/se3_interpolation.h"

namespace trajlo {

/// The planes of one segment's points. A point keeps its plane until it leaves its cell of the map;
/// a point without one asks again when the map has grown.
class SegmentAssociation {
 public:
  /// Takes every point to the world at its own time on T_begin..T_end, and looks up the planes of
  /// those that need one. `points` are the same at every call; `lidar_origins_body_m` says where
  /// each point's LiDAR is. `associated` receives the points that have a plane, in the order of
  /// `points`; it stays as it is where nothing is looked up, as when the poses are within
  /// `tolerance` of where they were. Returns the number of look-ups.
  int Associate(const std::vector<SegmentPoint>& points,
                const std::vector<Eigen::Vector3d>& lidar_origins_body_m, const SE3& T_begin,
                const SE3& T_end, const MapPyramid& map, const StepTolerance& tolerance,
                ThreadPool* threads, std::vector<RegistrationPoint>* associated);

 private:
  /// A LiDAR on its way through a segment.
  struct LidarPath {
    Eigen::Vector3d begin_world, way_world;
  };

  /// `has_grown`: the map, since the last call.
  static int Renew(const SegmentPoint* points, std::size_t count, const SegmentMotion& motion,
                   const std::vector<LidarPath>& lidars, const MapPyramid& map, bool has_grown,
                   VoxelKey* cells, Plane* found);

  /// Of each point: the cell in which it asked, and the answer.
  std::vector<VoxelKey> cells_;
  std::vector<Plane> planes_;
  /// At the last call.
  SE3 T_begin_, T_end_;
  std::int64_t map_version_ = -1;
  std::vector<int> chunk_searched_;
};

}  // namespace trajlo
