// SPDX-License-Identifier: MIT
#include "apps/evaluate/evaluation_table.h"

#include <algorithm>

#include "apps/evaluate/flag_values.h"
#include "apps/evaluate/metric_columns.h"
#include "core/io/format_text.h"

namespace trajlo {
namespace {

using Row = std::vector<std::string>;

/// How many columns of a terminal a text takes, if it is UTF-8.
std::size_t Width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) >> 6) != 2; }));
}

/// The first column to the left, the others to the right.
std::string Aligned(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths;
  for (const Row& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], Width(row[i]));
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string blanks(widths[i] - Width(row[i]), ' ');
      line += i == 0 ? row[i] + blanks : "  " + blanks + row[i];
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

std::string Line(const char* name, const std::string& text) {
  return FormatText("%-12s", name) + text + "\n";
}

std::string TrajectoryText(const TrajectorySummary& t) {
  return t.file + " (" + t.format + ", " + CountOf(t.poses, "pose") + ")";
}

std::string ComparedText(const EvaluateRequest& request, const EvaluationReport& report) {
  const EvaluationOptions& o = request.options;
  std::string text;
  if (!report.truth.has_stamps) {
    text = "poses paired line by line (no stamps)";
  } else if (o.association.rule == AssociationRule::kNearest) {
    text = FormatText("nearest poses within %g s", o.association.max_time_difference_s);
  } else if (o.association.rule == AssociationRule::kOneToOne) {
    text = FormatText("one-to-one pairs of poses closer than %g s",
                      o.association.max_time_difference_s);
  } else {
    text = o.association.rule == AssociationRule::kInterpolate
               ? "ground truth interpolated at the times of the estimate"
               : "estimate interpolated at the times of the ground truth";
  }
  text += std::string("; alignment ") + AlignmentName(o.alignment.kind);
  if (o.alignment.first_pairs > 0) {
    text += " of the first " + CountOf(o.alignment.first_pairs, "pair");
  }
  if (o.alignment.first_seconds > 0.0) {
    text += FormatText(" of the first %g s", o.alignment.first_seconds);
  }
  if (!report.truth_has_orientation) text += "; the ground truth has no orientation";
  return text;
}

Row StatisticsRow(const std::string& name, const ErrorStatistics& s, int decimals) {
  Row row = {name};
  for (const double value : {s.rmse, s.mean, s.median, s.std, s.min, s.max}) {
    row.push_back(FormatValue(value, decimals));
  }
  row.push_back(std::to_string(s.count));
  return row;
}

std::string OffsetText(const Evaluation& e) {
  std::string text = FormatText("%.6g s is added to the stamps of the estimate", e.time_offset_s);
  if (e.estimated_time_offset) {
    text += FormatText("; estimated, it takes the position error from %.4g to %.4g m",
                       e.estimated_time_offset->rmse_around_m, e.estimated_time_offset->rmse_m);
  }
  return text;
}

std::string KittiText(const Evaluation& e) {
  if (!e.kitti) return "none: " + e.kitti_reason;
  return FormatText("%.4f %%, %.6f deg/m over %zu pieces of 100 to 800 m",
                    e.kitti->translation_percent, e.kitti->rotation_deg_per_m,
                    e.kitti->segments.size());
}

std::string OfOne(const EvaluateRequest& request, const EvaluationReport& report) {
  const EstimateReport& estimate = report.estimates.front();
  const Evaluation& e = *estimate.evaluation;
  std::string text = Line("estimate", TrajectoryText(estimate.trajectory)) +
                     Line("truth", TrajectoryText(report.truth)) +
                     Line("compared", ComparedText(request, report));
  if (e.time_offset_s != 0.0 || e.estimated_time_offset) text += Line("time offset", OffsetText(e));
  text +=
      Line("pairs", FormatText("%zu, %.1f %% of the poses; %.1f %% of the ground truth covered; "
                               "%.2f m, %.1f s",
                               e.pairs.size(), 100.0 * e.paired_share, 100.0 * e.completeness,
                               e.path_length_m, e.duration_s));
  if (e.alignment.scale != 1.0) text += Line("scale", FormatText("%.6f", e.alignment.scale));
  std::vector<Row> rows = {{"", "rmse", "mean", "median", "std", "min", "max", "pairs"}};
  const auto add = [&](const std::string& name, const PoseErrorStatistics& s) {
    if (s.translation_m.count > 0) {
      rows.push_back(StatisticsRow(name + " [m]", s.translation_m, 4));
    }
    if (s.rotation_deg.count > 0) {
      const bool in_doubt = &s == &e.absolute && !e.rotation_determined;
      rows.push_back(StatisticsRow(name + (in_doubt ? " [deg] ?" : " [deg]"), s.rotation_deg, 3));
    }
    if (s.translation_m.count == 0 && s.point_distance_m.count > 0) {
      rows.push_back(StatisticsRow(name + " dist. [m]", s.point_distance_m, 4));
    }
  };
  add("ATE", e.absolute);
  std::string reasons;
  for (const RelativeEvaluation& relative : e.relative) {
    add("RPE " + PieceName(relative.options), relative.statistics);
    if (!relative.reason.empty()) {
      reasons += Line(("RPE " + PieceName(relative.options)).c_str(), "none: " + relative.reason);
    }
  }
  text += "\n" + Aligned(rows) + "\n" + reasons + Line("KITTI", KittiText(e));
  if (estimate.Diverged()) {
    text += (e.incomplete ? "INCOMPLETE x  " : "DIVERGED x  ") + e.divergence_reason + "\n";
  }
  return text;
}

std::string OfSeveral(const EvaluateRequest& request, const EvaluationReport& report) {
  const std::vector<MetricColumn> columns = MainColumns(report, request.options.relative);
  std::vector<Row> rows = {{"estimate", "pairs", "covered"}};
  for (const MetricColumn& column : columns) rows[0].push_back(column.title + "  ");
  std::string notes;
  bool doubts = false;
  for (const EstimateReport& estimate : report.estimates) {
    if (estimate.Diverged()) {
      const bool incomplete = estimate.evaluation && estimate.evaluation->incomplete;
      notes += "x " + estimate.name + (incomplete ? " is incomplete: " : ": ") +
               estimate.DivergenceReason() + "\n";
    }
    if (!estimate.evaluation) {
      rows.push_back({estimate.name, "0", ""});
      rows.back().resize(3 + columns.size(), "x");
      continue;
    }
    const Evaluation& e = *estimate.evaluation;
    if (e.estimated_time_offset) notes += "  " + estimate.name + ": " + OffsetText(e) + "\n";
    if (!e.kitti) notes += "  " + estimate.name + " has no KITTI errors: " + e.kitti_reason + "\n";
    rows.push_back({estimate.name, std::to_string(e.pairs.size()),
                    FormatText("%.1f %%", 100.0 * e.completeness)});
    for (const MetricColumn& column : columns) {
      const std::string value = FormatValue(column.value(e), column.decimals);
      const bool in_doubt = column.IsInDoubt(e);
      const bool best = !estimate.Diverged() && !in_doubt && value == BestValue(report, column);
      doubts = doubts || in_doubt;
      rows.back().push_back(value.empty() ? "-  "
                                          : value + (estimate.Diverged() ? " x"
                                                     : in_doubt          ? " ?"
                                                     : best              ? " *"
                                                                         : "  "));
    }
  }
  const std::string no_best = CoveredDifferently(report);
  if (!no_best.empty()) notes += no_best + "\n";
  std::string text = Line("truth", TrajectoryText(report.truth)) +
                     Line("compared", ComparedText(request, report)) + "\n" + Aligned(rows) +
                     "\nrmse; " + (no_best.empty() ? "* the best; " : "") +
                     "x diverged: " + DivergenceRule(request.options.divergence) + "\n" +
                     (doubts ? "? mostly a turn that the alignment leaves open\n" : "") + notes;
  return text;
}

}  // namespace

std::string EvaluationTable(const EvaluateRequest& request, const EvaluationReport& report) {
  const bool one = report.estimates.size() == 1 && report.estimates.front().evaluation;
  return one ? OfOne(request, report) : OfSeveral(request, report);
}

}  // namespace trajlo
