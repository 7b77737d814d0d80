// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/odometry/segments/segment_cloud.h"

namespace trajlo {

/// Segments in a row as one, in which every point keeps its time.
SegmentCloud JoinSegments(const std::vector<SegmentCloud>& segments);

}  // namespace trajlo
