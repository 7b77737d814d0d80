// SPDX-License-Identifier: MIT
#include "core/odometry/window/associate_window.h"

namespace trajlo {

int AssociateWindow(const MapPyramid& map, const AssociationOptions& options, double threshold_m,
                    bool renew, ThreadPool* threads, Window* window) {
  int searched = 0;
  for (int k = 0; k < window->size(); ++k) {
    const SE3 T_begin = window->Pose(k);
    Segment& segment = window->segments[static_cast<std::size_t>(k)];
    searched += segment.association.Associate(segment.cloud.registration_points, T_begin,
                                              segment.T_world_end, map, options, threshold_m, renew,
                                              threads, &segment.points);
  }
  return searched;
}

}  // namespace trajlo
