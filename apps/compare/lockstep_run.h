// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <vector>

#include "apps/compare/compare_request.h"
#include "apps/compare/feed_recording.h"
#include "core/comparison/lockstep_totals.h"

namespace trajlo {

/// Runs the recording once, all variants solving the same windows; writes lockstep.csv and
/// iterations.csv. `variants` are those that can be compared by single windows; the result is in
/// their order, and `feed` says what became of the recording. Ends early when `stop` is set. Throws
/// InputError, OutputError.
std::vector<LockstepTotals> RunLockstep(const CompareRequest& request,
                                        const std::vector<SolverVariant>& variants,
                                        const std::atomic<bool>& stop, Feed* feed);

}  // namespace trajlo
