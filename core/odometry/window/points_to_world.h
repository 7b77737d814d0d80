// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "core/odometry/segments/segment_cloud.h"
#include "manifolds/se3_interpolation.h"

namespace trajlo {

/// Takes `count` points of a segment to the world, each at its own time, and four of them at a
/// time: SegmentMotion::ToWorld for many.
void PointsToWorld(const SegmentMotion& motion, const SegmentPoint* points, std::size_t count,
                   Eigen::Vector3d* places_world);

std::vector<Eigen::Vector3d> PointsToWorld(const SegmentMotion& motion,
                                           const std::vector<SegmentPoint>& points);

}  // namespace trajlo
