// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/evaluation/timed_poses.h"

namespace trajlo {

/// The share of the truth's poses that the estimate covers: those that lie between two successive
/// poses of the estimate at most `max_gap_s` apart, or on one. Counting poses instead of time
/// leaves the truth's own gaps out. 1 if nothing is known about the times.
double Completeness(const TimedPoses& estimate, const TimedPoses& truth,
                    std::int64_t time_offset_ns, double max_gap_s);

}  // namespace trajlo
