// SPDX-License-Identifier: MIT
#include "core/odometry/window/associate_window.h"

namespace trajlo {

int AssociateWindow(const MapPyramid& map, ThreadPool* threads, Window* window) {
  int searched = 0;
  for (int k = 0; k < window->size(); ++k) {
    const SE3 T_begin = window->Pose(k);
    Segment& segment = window->segments[static_cast<std::size_t>(k)];
    const SegmentCloud& cloud = segment.cloud;
    searched +=
        segment.association.Associate(cloud.registration_points, cloud.lidar_origins_body_m,
                                      T_begin, segment.T_world_end, map, threads, &segment.points);
  }
  return searched;
}

}  // namespace trajlo
