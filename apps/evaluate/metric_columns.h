// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/evaluate/evaluation_report.h"

namespace trajlo {

/// A number that is known of every estimate, as tables show it.
struct MetricColumn {
  std::string key;    ///< In evaluation.csv, with the unit: "ate_translation_rmse_m".
  std::string title;  ///< In tables for people: "ATE [m]".
  int decimals = 3;
  /// Among those that every table shows; the others are in evaluation.csv only.
  bool main = false;
  /// Nothing if it was not computed.
  std::function<std::optional<double>(const Evaluation&)> value;
  /// It is an absolute rotation error, which depends on how well the alignment fixes the rotation.
  bool absolute_rotation = false;

  bool IsInDoubt(const Evaluation& e) const { return absolute_rotation && !e.rotation_determined; }
};

/// Absolute errors, relative errors of the pieces asked for, and KITTI's errors.
std::vector<MetricColumn> MetricColumns(const std::vector<RelativeErrorOptions>& pieces);

/// The main columns that at least one estimate has a value in, with decimals enough to tell the
/// estimates apart.
std::vector<MetricColumn> MainColumns(const EvaluationReport& report,
                                      const std::vector<RelativeErrorOptions>& pieces);
/// Why no best is marked: estimates that did not diverge cover different shares of the truth. Empty
/// if they do not.
std::string CoveredDifferently(const EvaluationReport& report);

/// The smallest value of a column among the estimates that did not diverge, and those that are not
/// in doubt, as it is printed; empty if there are fewer than two to choose from.
std::string BestValue(const EvaluationReport& report, const MetricColumn& column);

/// "0.023"; empty for nothing, "-" for what is no number.
std::string FormatValue(const std::optional<double>& value, int decimals);

/// "1 m"
std::string PieceName(const RelativeErrorOptions& piece);

}  // namespace trajlo
