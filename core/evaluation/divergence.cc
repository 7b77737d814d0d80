// SPDX-License-Identifier: MIT
#include "core/evaluation/divergence.h"

#include "core/io/format_text.h"

namespace trajlo {

std::string DivergenceReason(const ErrorStatistics& ate_m, double path_length_m,
                             double completeness, const DivergenceOptions& options) {
  if (!ate_m.IsFinite()) return "the absolute error is not finite";
  if (options.ate_m > 0.0 && ate_m.rmse > options.ate_m) {
    return FormatText("the absolute error of %.3g m is above %g m", ate_m.rmse, options.ate_m);
  }
  if (ate_m.rmse > options.ate_share_of_path * path_length_m && ate_m.rmse > options.ate_floor_m) {
    return FormatText("the absolute error of %.3g m is above %g %% of the path of %.4g m",
                      ate_m.rmse, 100.0 * options.ate_share_of_path, path_length_m);
  }
  if (completeness < options.min_completeness) {
    return FormatText(
        "the estimate covers %.1f %% of the ground truth, less than %g %% (--min_completeness=0 "
        "accepts it)",
        100.0 * completeness, 100.0 * options.min_completeness);
  }
  return "";
}

bool IsIncomplete(const ErrorStatistics& ate_m, double path_length_m, double completeness,
                  DivergenceOptions options) {
  if (completeness >= options.min_completeness) return false;
  options.min_completeness = 0.0;
  return DivergenceReason(ate_m, path_length_m, completeness, options).empty();
}

std::string DivergenceRule(const DivergenceOptions& options) {
  std::string rule = FormatText(
      "the rmse of the absolute error is not finite, or above %g %% of the "
      "path and %g m",
      100.0 * options.ate_share_of_path, options.ate_floor_m);
  if (options.ate_m > 0.0) rule += FormatText(", or above %g m", options.ate_m);
  return rule + FormatText(", or less than %g %% of the ground truth is covered",
                           100.0 * options.min_completeness);
}

}  // namespace trajlo
