// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "core/odometry/map/map_point.h"
#include "core/odometry/segments/segment_cloud.h"
#include "core/odometry/window/lidar_path.h"
#include "manifolds/se3_interpolation.h"

namespace trajlo {

/// Takes `count` points of a segment to the world, each at its own time, and four of them at a
/// time: SegmentMotion::ToWorld for many.
void PointsToWorld(const SegmentMotion& motion, const SegmentPoint* points, std::size_t count,
                   Eigen::Vector3d* places_world);

std::vector<Eigen::Vector3d> PointsToWorld(const SegmentMotion& motion,
                                           const std::vector<SegmentPoint>& points);

/// As the map takes them. `lidars`: the path of each LiDAR during the segment.
std::vector<MapPoint> ToMapPoints(const SegmentMotion& motion, const std::vector<LidarPath>& lidars,
                                  const SegmentPoint* points, std::size_t count);

}  // namespace trajlo
