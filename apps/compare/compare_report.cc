// SPDX-License-Identifier: MIT
#include "apps/compare/compare_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/compare/compare_warnings.h"
#include "core/io/format_text.h"
#include "core/io/stamp_text.h"
#include "core/report/csv_row.h"
#include "core/report/versions.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

using Json = nlohmann::ordered_json;

double Ratio(double value, double to) { return to > 0.0 ? value / to : 0.0; }

const FreeResult* FindFree(const CompareReport& report, const std::string& name) {
  const auto found = std::find_if(report.free.begin(), report.free.end(),
                                  [&](const FreeResult& result) { return result.name == name; });
  return found == report.free.end() ? nullptr : &*found;
}

std::string LockstepTable(const CompareReport& report) {
  std::string text = "lockstep: " + CountOf(report.lockstep.front().windows(), "window") +
                     ", each solved by all from the same start; ms: median per window\n";
  text += FormatText("  %-22s %7s %9s %9s %9s %9s %7s %10s %10s\n", "variant", "steps", "rejected",
                     "eval ms", "linear ms", "total ms", "ratio", "median m", "max m");
  for (std::size_t i = 0; i < report.lockstep.size(); ++i) {
    const LockstepTotals& t = report.lockstep[i];
    text +=
        FormatText("  %-22s %7.2f %9d %9.3f %9.3f %9.3f %7.2f %10.1e %10.1e\n",
                   report.lockstep_variants[i].name.c_str(), t.StepsPerWindow(), t.rejected_steps(),
                   t.MedianEvaluateMs(), t.MedianLinearSolveMs(), t.MedianTotalMs(),
                   Ratio(t.MedianTotalMs(), report.lockstep.front().MedianTotalMs()),
                   t.MedianDistance_m(), t.MaxDistance_m());
  }
  return text;
}

/// With a question mark where there is a warning.
std::string AteText(const FreeResult& r) {
  if (!r.AteRmse_m()) return "-";
  return FormatText("%.4f%s", *r.AteRmse_m(), r.truth_error->warnings.empty() ? "" : " ?");
}

std::string FreeTable(const CompareReport& report) {
  std::string text =
      "free: each runs the whole recording by itself; ratio and apart: to the first variant; solve "
      "ms: median per window\n";
  text += FormatText("  %-22s %9s %7s %9s %9s %11s %13s %9s\n", "variant", "cpu s", "ratio",
                     "solve ms", "rejected", "apart m", "apart after s", "ATE m");
  for (const FreeResult& r : report.free) {
    const std::string apart_after =
        r.parts_at_ns ? FormatText("%.2f", Seconds(*r.parts_at_ns - r.poses.front().t_ns))
                      : "never";
    text += FormatText("  %-22s %9.2f %7.2f %9.3f %9d %11.1e %13s %9s%s\n", r.name.c_str(), r.cpu_s,
                       Ratio(r.cpu_s, report.free.front().cpu_s), r.median_solve_ms,
                       r.rejected_steps, r.max_from_first_m, apart_after.c_str(),
                       AteText(r).c_str(), r.feed.lost_at_ns ? "  lost" : "");
  }
  return text;
}

Json LockstepJson(const LockstepTotals& t) {
  return {{"windows", t.windows()},
          {"not_finite", t.not_finite()},
          {"steps_per_window", t.StepsPerWindow()},
          {"rejected_steps", t.rejected_steps()},
          {"median_evaluate_ms", t.MedianEvaluateMs()},
          {"median_linear_solve_ms", t.MedianLinearSolveMs()},
          {"median_total_ms", t.MedianTotalMs()},
          {"cost_after", t.CostAfter()},
          {"median_from_first_m", t.MedianDistance_m()},
          {"max_from_first_m", t.MaxDistance_m()},
          {"max_from_first_rad", t.MaxDistance_rad()}};
}

/// Also why there is no error, where that is so.
std::vector<std::string> TruthWarnings(const FreeResult& r) {
  if (!r.truth_error) return {};
  return r.truth_error->failure.empty() ? r.truth_error->warnings
                                        : std::vector{r.truth_error->failure};
}

Json FreeJson(const FreeResult& r) {
  const bool compared = r.AteRmse_m().has_value();
  return {
      {"trajectory", "free/" + r.name + "/trajectory.tum"},
      {"poses", r.poses.size()},
      {"poses_compared", r.poses_compared},
      {"cpu_s", r.cpu_s},
      {"wall_s", r.feed.wall_s},
      {"windows", r.windows.windows},
      {"rounds", r.windows.rounds},
      {"rejected_steps", r.rejected_steps},
      {"median_solve_ms", r.median_solve_ms},
      {"stages_ms",
       {{"segment", r.windows.segment_ms},
        {"associate", r.windows.associate_ms},
        {"solve", r.windows.solve_ms},
        {"marginalize", r.windows.marginalize_ms},
        {"map", r.windows.map_ms}}},
      {"lost_at_s", r.feed.lost_at_ns ? Json(FormatSeconds(*r.feed.lost_at_ns)) : Json(nullptr)},
      {"max_from_first_m", r.max_from_first_m},
      {"parts_at_s", r.parts_at_ns ? Json(FormatSeconds(*r.parts_at_ns)) : Json(nullptr)},
      {"ate_rmse_m", r.AteRmse_m() ? Json(*r.AteRmse_m()) : Json(nullptr)},
      {"truth_pairs", compared ? Json(r.truth_error->pairs) : Json(nullptr)},
      {"truth_covered_share", compared ? Json(r.truth_error->covered_share) : Json(nullptr)},
      {"truth_warnings", TruthWarnings(r)}};
}

CsvRow RowOf(const std::string& name, const Json& values) {
  CsvRow row;
  row.Add("variant", name);
  for (const auto& [key, value] : values.items()) {
    // Every row has the same columns, whatever is known of its variant.
    if (value.is_number()) row.Add(key.c_str(), value.dump());
    if (value.is_null()) row.Add(key.c_str(), std::string());
    if (value.is_string()) row.Add(key.c_str(), value.get<std::string>());
  }
  return row;
}

}  // namespace

bool HasWindows(const CompareReport& report) {
  const auto has_some = [](const LockstepTotals& totals) { return totals.windows() > 0; };
  return std::any_of(report.lockstep.begin(), report.lockstep.end(), has_some) ||
         std::any_of(report.free.begin(), report.free.end(),
                     [](const FreeResult& result) { return result.windows.windows > 0; });
}

std::string CompareTables(const CompareReport& report) {
  std::string text;
  if (!HasWindows(report)) return text;
  if (!report.lockstep.empty()) text += LockstepTable(report);
  if (!report.not_in_lockstep.empty()) {
    text += "  by whole runs only, as more changes than how a window is solved:";
    for (const std::string& name : report.not_in_lockstep) text += " " + name;
    text += "\n";
  }
  if (!report.free.empty()) text += FreeTable(report);
  return text;
}

std::string CompareJson(const CompareRequest& request, const CompareReport& report) {
  Json variants = Json::array();
  for (const SolverVariant& variant : request.variants) {
    Json json = {{"name", variant.name}, {"set", variant.settings}};
    for (std::size_t i = 0; i < report.lockstep.size(); ++i) {
      if (report.lockstep_variants[i].name != variant.name) continue;
      json["lockstep"] = LockstepJson(report.lockstep[i]);
    }
    if (const FreeResult* result = FindFree(report, variant.name)) json["free"] = FreeJson(*result);
    variants.push_back(std::move(json));
  }
  std::vector<std::string> warnings = report.warnings;
  for (const auto& of_runs : {WarningsOfRuns(report), FailuresOfRuns(report)}) {
    warnings.insert(warnings.end(), of_runs.begin(), of_runs.end());
  }
  const Versions v = GetVersions();
  const Json json = {
      {"command_line", request.command_line},
      {"is_whole", report.is_whole},
      {"warnings", warnings},
      {"input", request.inputs},
      {"truth", request.truth.empty() ? Json(nullptr) : Json(request.truth)},
      {"lockstep_options",
       {{"every", request.lockstep_options.every},
        {"max_iterations", request.lockstep_options.max_iterations},
        {"step_tolerance_m", request.lockstep_options.step_tolerance.translation_m},
        {"step_tolerance_rad", request.lockstep_options.step_tolerance.rotation_rad}}},
      {"versions",
       {{"trajlo", v.trajlo},
        {"git", v.git},
        {"eigen", v.eigen},
        {"ceres", v.ceres},
        {"compiler", v.compiler}}},
      {"variants", variants}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string LockstepSummaryCsv(const CompareReport& report) {
  std::string text;
  for (std::size_t i = 0; i < report.lockstep.size(); ++i) {
    const CsvRow row = RowOf(report.lockstep_variants[i].name, LockstepJson(report.lockstep[i]));
    text += (i == 0 ? row.Names() : "") + row.Values();
  }
  return text;
}

std::string FreeSummaryCsv(const CompareReport& report) {
  std::string text;
  for (std::size_t i = 0; i < report.free.size(); ++i) {
    const CsvRow row = RowOf(report.free[i].name, FreeJson(report.free[i]));
    text += (i == 0 ? row.Names() : "") + row.Values();
  }
  return text;
}

}  // namespace trajlo
