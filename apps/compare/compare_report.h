// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/compare/compare_request.h"
#include "apps/compare/free_run.h"
#include "core/comparison/lockstep_totals.h"

namespace trajlo {

/// All that a comparison found; the lists are empty if that part was not asked for.
struct CompareReport {
  /// The variants of the lockstep run and, in the same order, what they did.
  std::vector<SolverVariant> lockstep_variants;
  std::vector<LockstepTotals> lockstep;
  Feed lockstep_feed;
  /// Variants that differ in more than the solution of a window.
  std::vector<std::string> not_in_lockstep;
  std::vector<FreeResult> free;
  /// About the request and the truth's file; those of the runs are theirs.
  std::vector<std::string> warnings;
  bool is_whole = false;  ///< It came to its end: no signal ended it early.
};

/// Whether any window was solved by all variants, or any run has a window.
bool HasWindows(const CompareReport& report);
/// Aligned columns for the screen; times as ratios to the first variant.
std::string CompareTables(const CompareReport& report);
/// comparison.json: everything, with the settings of each variant and the versions.
std::string CompareJson(const CompareRequest& request, const CompareReport& report);
/// Tidy tables with a line per variant; empty if there is nothing to say.
std::string LockstepSummaryCsv(const CompareReport& report);
std::string FreeSummaryCsv(const CompareReport& report);

}  // namespace trajlo
