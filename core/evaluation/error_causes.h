// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/evaluation/association.h"
#include "core/evaluation/timed_poses.h"

namespace trajlo {

/// Errors that are none of the estimate's.

/// Where the truth is interpolated: how far the body is from the straight lines between poses of
/// the truth, RMS over the stamps of the estimate in between, in metres. The estimate says so
/// itself: `truth` gives the times only. 0 if it reaches across no two of them.
double StraightLineError_m(const TimedPoses& estimate, const TimedPoses& truth,
                           std::int64_t time_offset_ns, double max_gap_s);

/// What a difference of the clocks would explain.
struct ClockDifference {
  double offset_s = 0.0;  ///< To be added to the stamps of the estimate.
  double share = 0.0;     ///< Of the sum of squared position errors.
};

/// The offset that explains most of the errors of aligned pairs, to first order: an estimate that
/// is late by dt is off by its velocity times dt.
ClockDifference ExplainByClocks(const std::vector<PosePair>& pairs);

}  // namespace trajlo
