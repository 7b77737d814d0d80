// SPDX-License-Identifier: MIT
#include "core/odometry/segments/join_segments.h"

namespace trajlo {

SegmentCloud JoinSegments(const std::vector<SegmentCloud>& segments) {
  if (segments.size() == 1) return segments.front();
  SegmentCloud joined;
  joined.begin_ns = segments.front().begin_ns;
  joined.end_ns = segments.back().end_ns;
  joined.lidar_origins_body_m = segments.back().lidar_origins_body_m;
  const double duration_s = joined.Duration_s();
  for (const SegmentCloud& segment : segments) {
    const double first = Seconds(segment.begin_ns - joined.begin_ns) / duration_s;
    const double share = segment.Duration_s() / duration_s;
    const auto append = [&](const std::vector<SegmentPoint>& from, std::vector<SegmentPoint>* to) {
      for (SegmentPoint point : from) {
        point.alpha = static_cast<float>(first + share * static_cast<double>(point.alpha));
        to->push_back(point);
      }
    };
    append(segment.map_points, &joined.map_points);
    append(segment.registration_points, &joined.registration_points);
  }
  return joined;
}

}  // namespace trajlo
