// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "core/export/run_result.h"
#include "core/export/scan_placer.h"
#include "core/io/scan_source.h"

namespace trajlo {

/// Reads the recording of a run again, gives its scans the times that the estimator gave them, and
/// visits those of which points can be placed. Ends early when `visit` returns false.
PlacementCounts ReplayRecording(const RunResult& result, ScanSource* recording,
                                const std::function<bool(const PlacedScan&)>& visit);

}  // namespace trajlo
