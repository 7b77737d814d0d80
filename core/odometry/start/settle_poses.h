// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/odometry/odometry_options.h"
#include "core/odometry/parallel/thread_pool.h"
#include "core/odometry/segments/segment_cloud.h"

namespace trajlo {

/// The control poses of some segments, and how many points agree with them.
struct SettledPoses {
  std::vector<SE3> poses;  ///< One more than segments.
  int agreeing = 0;        ///< So many points lie on planes of the other half.
};

/// Brings the two halves of a stretch together that has no map yet. Each half is a map for the
/// points of the other, and both move. The control poses are free, and tied by the motion prior;
/// the first one stays. Whoever walks or flies does not keep a twist for 0.3 s: after that the best
/// constant one is off by some centimetres and by 0.02 to 0.1 rad, which is much at 20 m.
///
/// `poses` is where to begin: one more than `segments`, of which there are at least two. With
/// `is_coarse` the voxels and kernels of the first rounds are wider.
SettledPoses SettlePoses(const std::vector<SegmentCloud>& segments, const std::vector<SE3>& poses,
                         bool is_coarse, const OdometryOptions& options, ThreadPool* threads);

}  // namespace trajlo
