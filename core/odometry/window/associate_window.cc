// SPDX-License-Identifier: MIT
#include "core/odometry/window/associate_window.h"

namespace trajlo {

int AssociateWindow(const MapPyramid& map, const StepTolerance& tolerance, ThreadPool* threads,
                    Window* window) {
  int searched = 0;
  for (int k = 0; k < window->size(); ++k) {
    const SE3 T_begin = window->Pose(k);
    Segment& segment = window->segments[static_cast<std::size_t>(k)];
    const SegmentCloud& cloud = segment.cloud;
    const int asked = segment.association.Associate(
        cloud.registration_points, cloud.lidar_origins_body_m, T_begin, segment.T_world_end, map,
        tolerance, threads, &segment.points);
    if (asked > 0) segment.linearization.reset();
    searched += asked;
  }
  return searched;
}

}  // namespace trajlo
