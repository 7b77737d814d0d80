// SPDX-License-Identifier: MIT
#include "apps/evaluate/metric_columns.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/io/format_text.h"

namespace trajlo {
namespace {

using Member = double ErrorStatistics::*;

const std::vector<std::pair<const char*, Member>> kStatistics = {
    {"rmse", &ErrorStatistics::rmse},     {"mean", &ErrorStatistics::mean},
    {"median", &ErrorStatistics::median}, {"std", &ErrorStatistics::std},
    {"min", &ErrorStatistics::min},       {"max", &ErrorStatistics::max}};

std::optional<double> IfCounted(const ErrorStatistics& statistics, Member member) {
  if (statistics.count == 0) return {};
  return statistics.*member;
}

void AddAbsolute(std::vector<MetricColumn>* columns) {
  for (const auto& [name, member] : kStatistics) {
    const bool main = member == &ErrorStatistics::rmse;
    columns->push_back(
        {"ate_translation_" + std::string(name) + "_m", "ATE [m]", 3, main,
         [m = member](const Evaluation& e) { return IfCounted(e.absolute.translation_m, m); }});
  }
  for (const auto& [name, member] : kStatistics) {
    const bool main = member == &ErrorStatistics::rmse;
    columns->push_back(
        {"ate_rotation_" + std::string(name) + "_deg", "ATE [deg]", 2, main,
         [m = member](const Evaluation& e) { return IfCounted(e.absolute.rotation_deg, m); },
         true});
  }
}

void AddRelative(const RelativeErrorOptions& piece, std::size_t index,
                 std::vector<MetricColumn>* columns) {
  const std::string key = FormatText("rpe_%g%s", piece.delta, DeltaUnitName(piece.unit));
  const std::string title = "RPE " + PieceName(piece);
  columns->push_back({key + "_pairs", "", 0, false, [index](const Evaluation& e) {
                        return static_cast<double>(e.relative[index].pieces);
                      }});
  const auto add = [&](const char* suffix, const char* unit, int decimals,
                       ErrorStatistics PoseErrorStatistics::*kind, bool main) {
    columns->push_back(
        {key + suffix, title + unit, decimals, main, [index, kind](const Evaluation& e) {
           return IfCounted(e.relative[index].statistics.*kind, &ErrorStatistics::rmse);
         }});
  };
  add("_translation_rmse_m", " [m]", 3, &PoseErrorStatistics::translation_m, true);
  add("_rotation_rmse_deg", " [deg]", 2, &PoseErrorStatistics::rotation_deg, true);
  add("_point_distance_rmse_m", " dist. [m]", 3, &PoseErrorStatistics::point_distance_m, false);
}

/// As many as show three digits of the smallest value, but at most two more than usual:
/// estimates that differ by a tenth of a millimetre are not the same.
int Decimals(const MetricColumn& column, const EvaluationReport& report) {
  constexpr int kDigits = 3, kMore = 2;
  int decimals = column.decimals;
  for (const EstimateReport& estimate : report.estimates) {
    if (!estimate.evaluation) continue;
    const double value = column.value(*estimate.evaluation).value_or(0.0);
    if (!std::isfinite(value) || value <= std::pow(10.0, -column.decimals - kMore)) continue;
    decimals = std::max(decimals, kDigits - 1 - static_cast<int>(std::floor(std::log10(value))));
  }
  return std::min(decimals, column.decimals + kMore);
}

}  // namespace

std::string PieceName(const RelativeErrorOptions& piece) {
  return FormatText("%g %s", piece.delta, DeltaUnitName(piece.unit));
}

std::vector<MetricColumn> MetricColumns(const std::vector<RelativeErrorOptions>& pieces) {
  std::vector<MetricColumn> columns;
  AddAbsolute(&columns);
  for (std::size_t i = 0; i < pieces.size(); ++i) AddRelative(pieces[i], i, &columns);
  columns.push_back({"kitti_translation_percent", "KITTI [%]", 3, true, [](const Evaluation& e) {
                       return e.kitti ? std::optional(e.kitti->translation_percent) : std::nullopt;
                     }});
  columns.push_back({"kitti_rotation_deg_per_m", "KITTI [deg/m]", 5, true, [](const Evaluation& e) {
                       return e.kitti ? std::optional(e.kitti->rotation_deg_per_m) : std::nullopt;
                     }});
  return columns;
}

std::vector<MetricColumn> MainColumns(const EvaluationReport& report,
                                      const std::vector<RelativeErrorOptions>& pieces) {
  std::vector<MetricColumn> main;
  for (MetricColumn& column : MetricColumns(pieces)) {
    // All that is known of relative errors then.
    const bool without_orientation =
        !report.truth_has_orientation && column.key.find("_point_distance_") != std::string::npos;
    if (!column.main && !without_orientation) continue;
    const bool known = std::any_of(
        report.estimates.begin(), report.estimates.end(),
        [&](const EstimateReport& e) { return e.evaluation && column.value(*e.evaluation); });
    if (!known) continue;
    column.decimals = Decimals(column, report);
    main.push_back(std::move(column));
  }
  return main;
}

std::string FormatValue(const std::optional<double>& value, int decimals) {
  if (!value) return "";
  if (std::isnan(*value)) return "-";  // As the deviation of errors that are infinite.
  if (std::isinf(*value)) return *value < 0.0 ? "-inf" : "inf";
  return FormatText(*value < 1e7 ? "%.*f" : "%.*e", decimals, *value);
}

std::string CoveredDifferently(const EvaluationReport& report) {
  constexpr double kAlike = 0.03;
  double least = 1.0, most = 0.0;
  for (const EstimateReport& estimate : report.estimates) {
    if (estimate.Diverged()) continue;
    least = std::min(least, estimate.evaluation->completeness);
    most = std::max(most, estimate.evaluation->completeness);
  }
  if (most - least <= kAlike) return "";
  return FormatText(
      "no best is marked: the estimates cover different shares of the ground truth (%.1f to %.1f "
      "%%), and errors over different parts do not compare",
      100.0 * least, 100.0 * most);
}

std::string BestValue(const EvaluationReport& report, const MetricColumn& column) {
  if (!CoveredDifferently(report).empty()) return "";
  std::optional<double> best;
  std::size_t candidates = 0;
  for (const EstimateReport& estimate : report.estimates) {
    if (estimate.Diverged() || column.IsInDoubt(*estimate.evaluation)) continue;
    const std::optional<double> value = column.value(*estimate.evaluation);
    if (!value) continue;
    ++candidates;
    best = best ? std::min(*best, *value) : *value;
  }
  return candidates < 2 ? "" : FormatValue(best, column.decimals);
}

}  // namespace trajlo
