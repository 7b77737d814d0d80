// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/map/map_pyramid.h"
#include "core/odometry/parallel/thread_pool.h"
#include "core/odometry/segments/segment_cloud.h"
#include "manifolds/se3.h"

namespace trajlo {

/// Adds the map points of a segment to the map, each at its own time on T_begin..T_end.
void EnterMap(const SegmentCloud& cloud, const SE3& T_begin, const SE3& T_end, ThreadPool* threads,
              MapPyramid* map);

}  // namespace trajlo
