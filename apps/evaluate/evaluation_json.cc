// SPDX-License-Identifier: MIT
#include "apps/evaluate/evaluation_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/evaluate/flag_values.h"
#include "core/io/format_text.h"
#include "core/io/stamp_text.h"
#include "core/report/versions.h"

namespace trajlo {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity.
Json Finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json RowsJson(const Eigen::Matrix<double, 3, 4>& m) {
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) rows.push_back({m(i, 0), m(i, 1), m(i, 2), m(i, 3)});
  return rows;
}

/// As the flag --T_body_truth takes it.
std::string PoseText(const Eigen::Affine3d& T) {
  std::string text;
  for (int i = 0; i < 12; ++i) {
    text += FormatText("%s%.17g", i == 0 ? "" : ",", T.matrix()(i / 4, i % 4));
  }
  return text;
}

std::string PiecesText(const std::vector<RelativeErrorOptions>& pieces) {
  std::string text;
  for (const RelativeErrorOptions& piece : pieces) {
    text += FormatText("%s%g%s", text.empty() ? "" : ",", piece.delta, DeltaUnitName(piece.unit));
  }
  return text;
}

Json StatisticsJson(const ErrorStatistics& s) {
  if (s.count == 0) return nullptr;
  return {{"rmse", Finite(s.rmse)}, {"mean", Finite(s.mean)}, {"median", Finite(s.median)},
          {"std", Finite(s.std)},   {"min", Finite(s.min)},   {"max", Finite(s.max)}};
}

Json PoseErrorsJson(const PoseErrorStatistics& s) {
  return {{"translation_m", StatisticsJson(s.translation_m)},
          {"rotation_deg", StatisticsJson(s.rotation_deg)},
          {"rotation_part", StatisticsJson(s.rotation_part)},
          {"full", StatisticsJson(s.full)}};
}

Json RelativeJson(const RelativeEvaluation& relative) {
  Json json = {{"delta", relative.options.delta},
               {"unit", DeltaUnitName(relative.options.unit)},
               {"pairs", relative.pieces}};
  json.update(PoseErrorsJson(relative.statistics));
  json["point_distance_m"] = StatisticsJson(relative.statistics.point_distance_m);
  if (!relative.reason.empty()) json["reason"] = relative.reason;
  return json;
}

Json KittiJson(const KittiErrors& kitti) {
  Json per_length = Json::array();
  for (const KittiLength& length : kitti.per_length) {
    const bool some = length.segments > 0;
    per_length.push_back(
        {{"length_m", length.length_m},
         {"segments", length.segments},
         {"translation_percent", some ? Json(length.translation_percent) : Json(nullptr)},
         {"rotation_deg_per_m", some ? Json(length.rotation_deg_per_m) : Json(nullptr)}});
  }
  return {{"segments", kitti.segments.size()},
          {"translation_percent", kitti.translation_percent},
          {"rotation_deg_per_m", kitti.rotation_deg_per_m},
          {"per_length", per_length}};
}

Json AlignmentJson(const Alignment& alignment) {
  Eigen::Matrix<double, 3, 4> T;
  T << alignment.R, alignment.t;
  const std::optional<double> sigma_deg = RotationSigmaDeg(alignment);
  return {{"kind", AlignmentName(alignment.kind)},
          {"T", RowsJson(T)},
          {"scale", alignment.scale},
          {"rotation_sigma_deg", sigma_deg ? Finite(*sigma_deg) : Json(nullptr)},
          {"pairs_used", alignment.pairs_used}};
}

Json TrajectoryJson(const TrajectorySummary& t) {
  return {{"file", t.file},
          {"format", t.format},
          {"poses", t.poses},
          {"begin_s", t.has_stamps ? Json(FormatSeconds(t.begin_ns)) : Json(nullptr)},
          {"end_s", t.has_stamps ? Json(FormatSeconds(t.end_ns)) : Json(nullptr)},
          {"path_length_m", Finite(t.path_length_m)}};
}

/// All keys are there for every estimate, null where an estimate could not be evaluated.
Json EstimateJson(const EstimateReport& report) {
  Json json = {{"name", report.name},
               {"file", report.trajectory.file},
               {"errors_csv", report.evaluation ? Json(report.errors_csv) : Json(nullptr)},
               {"evaluated", report.evaluation.has_value()},
               {"diverged", report.Diverged()},
               {"divergence_reason", report.DivergenceReason()},
               {"incomplete", report.evaluation && report.evaluation->incomplete},
               {"trajectory", TrajectoryJson(report.trajectory)}};
  if (!report.evaluation) {
    for (const char* key :
         {"completeness", "paired_share", "covered_share", "path_length_m", "duration_s", "ate",
          "kitti", "alignment", "time_offset_s", "estimated_time_offset"}) {
      json[key] = nullptr;
    }
    json["pairs"] = 0;
    json["rpe"] = Json::array();
    json["kitti_reason"] = report.failure;
    return json;
  }
  const Evaluation& e = *report.evaluation;
  json["completeness"] = e.completeness;
  json["pairs"] = e.pairs.size();
  json["paired_share"] = e.paired_share;
  json["covered_share"] = e.covered_share;
  json["path_length_m"] = Finite(e.path_length_m);
  json["duration_s"] = e.duration_s;
  json["ate"] = PoseErrorsJson(e.absolute);
  json["ate"]["rotation_determined"] = e.rotation_determined;
  json["rpe"] = Json::array();
  for (const RelativeEvaluation& relative : e.relative) {
    json["rpe"].push_back(RelativeJson(relative));
  }
  json["kitti"] = e.kitti ? KittiJson(*e.kitti) : Json(nullptr);
  json["kitti_reason"] = e.kitti_reason;
  json["alignment"] = AlignmentJson(e.alignment);
  json["time_offset_s"] = e.time_offset_s;
  json["estimated_time_offset"] = nullptr;
  if (e.estimated_time_offset) {
    json["estimated_time_offset"] = {
        {"offset_s", e.estimated_time_offset->offset_s},
        {"rmse_m", Finite(e.estimated_time_offset->rmse_m)},
        {"rmse_without_m", Finite(e.estimated_time_offset->rmse_around_m)}};
  }
  return json;
}

Json SettingsJson(const EvaluateRequest& request) {
  const EvaluationOptions& o = request.options;
  // The flags set these for all pieces alike.
  const RelativeErrorOptions piece =
      o.relative.empty() ? RelativeErrorOptions() : o.relative.front();
  std::string command_line;
  for (const std::string& word : request.command_line) {
    command_line += (command_line.empty() ? "" : " ") + word;
  }
  return {{"association",
           {{"rule", AssociationName(o.association.rule)},
            {"max_time_difference_s", o.association.max_time_difference_s},
            {"max_gap_s", o.association.max_gap_s},
            {"repeated_stamps", RepeatedStampsName(request.repeated_stamps)}}},
          {"alignment",
           {{"kind", AlignmentName(o.alignment.kind)},
            {"first_pairs", o.alignment.first_pairs},
            {"first_seconds", o.alignment.first_seconds}}},
          {"T_body_truth", PoseText(o.T_body_truth)},
          {"time_offset",
           {{"given_s", o.time_offset_s},
            {"estimated", o.estimate_time_offset},
            {"reach_s", o.time_offset_reach_s}}},
          {"rpe",
           {{"pieces", PiecesText(o.relative)},
            {"all_pairs", piece.all_pairs},
            {"along_truth", piece.along_truth},
            {"tolerance", std::isfinite(piece.tolerance) ? Json(piece.tolerance) : Json("inf")}}},
          {"max_estimate_gap_s", o.max_estimate_gap_s},
          {"divergence",
           {{"rule", DivergenceRule(o.divergence)},
            {"ate_share_of_path", o.divergence.ate_share_of_path},
            {"ate_floor_m", o.divergence.ate_floor_m},
            {"ate_m", o.divergence.ate_m},
            {"min_completeness", o.divergence.min_completeness}}},
          {"times", request.times.string()},
          {"command_line", command_line}};
}

}  // namespace

std::string EvaluationJson(const EvaluateRequest& request, const EvaluationReport& report) {
  const Versions v = GetVersions();
  Json truth = TrajectoryJson(report.truth);
  truth["has_orientation"] = report.truth_has_orientation;
  Json estimates = Json::array();
  for (const EstimateReport& estimate : report.estimates) {
    estimates.push_back(EstimateJson(estimate));
  }
  const Json json = {
      {"truth", truth},
      {"estimates", estimates},
      {"settings", SettingsJson(request)},
      {"versions",
       {{"trajlo", v.trajlo}, {"git", v.git}, {"eigen", v.eigen}, {"compiler", v.compiler}}},
      {"warnings", report.warnings}};
  // Paths need not be UTF-8; such bytes are replaced rather than thrown at the user.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace trajlo
