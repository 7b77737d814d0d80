// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/compare/compare_request.h"
#include "apps/compare/feed_recording.h"
#include "apps/compare/truth_error.h"
#include "core/report/window_totals.h"

namespace trajlo {

/// What one variant made of the whole recording by itself.
struct FreeResult {
  std::string name;
  std::vector<StampedPose> poses;
  WindowTotals windows;
  int rejected_steps = 0;
  double median_solve_ms = 0.0;  ///< Of a window, over all its rounds.
  double cpu_s = 0.0;            ///< Of the whole process while it ran: reading and estimating.
  Feed feed;
  /// Against the first variant: how many poses have a time that it has, too, the largest distance
  /// of two such poses, and the time of the first pair that is farther apart than a micrometre.
  std::size_t poses_compared = 0;
  double max_from_first_m = 0.0;
  std::optional<std::int64_t> parts_at_ns;
  /// Nothing without truth.
  std::optional<TruthError> truth_error;

  std::optional<double> AteRmse_m() const {
    return truth_error ? truth_error->ate_rmse_m : std::nullopt;
  }
};

/// Runs the variant on the recording and writes `free/<name>/trajectory.tum` and `windows.csv`.
/// Ends early when `stop` is set. Throws InputError, OutputError.
FreeResult RunFree(const CompareRequest& request, const SolverVariant& variant,
                   const std::atomic<bool>& stop);

/// Fills in what compares a result with the first one.
void CompareWithFirst(const FreeResult& first, FreeResult* result);

}  // namespace trajlo
