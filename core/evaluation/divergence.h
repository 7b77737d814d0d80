// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/evaluation/error_statistics.h"

namespace trajlo {

/// When a run counts as failed, the x of the tables. Any one of the rules suffices.
struct DivergenceOptions {
  /// The rmse of the absolute translation error exceeds this share of the path length, and also
  /// `ate_floor_m`, so that a sensor that hardly moves is not called lost for its noise.
  double ate_share_of_path = 0.1;
  double ate_floor_m = 0.5;
  /// The rmse exceeds this; 0 switches the rule off.
  double ate_m = 0.0;
  /// The estimate covers less of the truth.
  double min_completeness = 0.5;
};

/// Why the run counts as failed; empty if it does not. Errors that are not finite always fail.
std::string DivergenceReason(const ErrorStatistics& ate_m, double path_length_m,
                             double completeness, const DivergenceOptions& options);

/// Whether that reason is that the estimate is short, and no other.
bool IsIncomplete(const ErrorStatistics& ate_m, double path_length_m, double completeness,
                  DivergenceOptions options);

/// The rules in a sentence.
std::string DivergenceRule(const DivergenceOptions& options);

}  // namespace trajlo
