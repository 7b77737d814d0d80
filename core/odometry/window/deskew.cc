// SPDX-License-Identifier: MIT
#include "core/odometry/window/deskew.h"

#include "manifolds/se3_interpolation.h"

namespace trajlo {

void DeskewToEnd(const Vector6d& tau, SegmentCloud* cloud) {
  // In the frame of the end, the segment begins at Exp(-tau).
  const SegmentMotion motion(se3::Exp(-tau), SE3());
  for (std::vector<SegmentPoint>* points : {&cloud->map_points, &cloud->registration_points}) {
    for (SegmentPoint& point : *points) {
      point.p_body_m = motion.ToWorld(point.alpha, point.p_body_m.cast<double>()).cast<float>();
      point.alpha = 1.0F;
    }
  }
}

}  // namespace trajlo
