// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/segments/segment_cloud.h"
#include "manifolds/se3.h"

namespace trajlo {

/// What moves the points of a segment to one time.
enum class Deskewing {
  kEstimated,  ///< The estimated trajectory, in every iteration anew: the paper's method.
  kPredicted,  ///< The predicted motion, once, before the segment is estimated.
};

/// Moves all points of a segment to its end by a constant twist, after which their alpha is 1:
/// p_end = Exp((alpha - 1) tau) p, where tau = [rho; theta] (m, rad; body frame) is the motion over
/// the whole segment.
void DeskewToEnd(const Vector6d& tau, SegmentCloud* cloud);

}  // namespace trajlo
