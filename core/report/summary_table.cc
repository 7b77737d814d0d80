// SPDX-License-Identifier: MIT
#include "core/report/summary_table.h"

#include "core/io/format_text.h"
#include "core/io/stamp_text.h"

namespace trajlo {
namespace {

std::string Line(const char* name, const std::string& text) {
  return FormatText("  %-12s", name) + text + "\n";
}

void AddCount(std::int64_t count, const char* what, std::string* text) {
  if (count == 0) return;
  *text += (text->empty() ? "" : ", ") + std::to_string(count) + " " + what;
}

std::string Dropped(const RunSummary& s) {
  std::string text;
  AddCount(s.NotFinite(), "not finite", &text);
  AddCount(s.points.too_near, "too near", &text);
  AddCount(s.points.too_far, "too far", &text);
  AddCount(s.points.too_late, "too late", &text);
  AddCount(s.points.wrong_time, "at wrong times", &text);
  AddCount(static_cast<std::int64_t>(s.read.points_without_time), "without a possible time", &text);
  return text.empty() ? "nothing" : text + " of " + CountOf(s.points.received, "point");
}

/// "gap 1 (2.0 s), ...": poses, and the time that they stand for.
std::string Flagged(const PoseFlags& flags) {
  std::string text;
  for (const auto& [name, total] : flags.totals()) {
    if (total.poses == 0) continue;
    text +=
        (text.empty() ? "" : ", ") + name + FormatText(" %zu (%.2f s)", total.poses, total.seconds);
  }
  return text.empty() ? text : text + "; see flags.csv";
}

/// "associate 61 %, solve 20 %, ..." of the time that the windows took.
std::string Stages(const WindowTotals& w) {
  const double sum = w.segment_ms + w.associate_ms + w.solve_ms + w.marginalize_ms + w.map_ms;
  if (sum <= 0.0) return "";
  return FormatText(
      "segment %.0f %%, associate %.0f %%, solve %.0f %%, marginalize %.0f %%, map %.0f %%",
      100.0 * w.segment_ms / sum, 100.0 * w.associate_ms / sum, 100.0 * w.solve_ms / sum,
      100.0 * w.marginalize_ms / sum, 100.0 * w.map_ms / sum);
}

}  // namespace

std::string SummaryTable(const RunSummary& s) {
  std::string table;
  table += Line("input",
                FormatText("%zu of ", s.read.scans_read) + CountOf(s.read.scans_listed, "scan") +
                    FormatText(", %.2f million points, %.1f s",
                               1e-6 * static_cast<double>(s.points.received), s.DataSeconds()));
  table += Line("dropped", Dropped(s));
  const std::string stamps = s.OddStamps();
  if (!stamps.empty()) table += Line("scans", stamps);
  table += Line("trajectory", CountOf(s.poses_written, "pose") +
                                  FormatText(", %.2f m long, ends %.2f m from its start",
                                             s.path_length_m, s.distance_to_start_m));
  table += Line("windows", s.windows.windows == 0
                               ? "none"
                               : std::to_string(s.windows.windows) +
                                     FormatText(", %.0f points each, %.0f %% inliers, %.1f rounds",
                                                s.windows.Mean(s.windows.points),
                                                100.0 * s.windows.InlierShare(),
                                                s.windows.Mean(s.windows.rounds)));
  const std::string flagged = Flagged(s.flags);
  if (!flagged.empty()) table += Line("flagged", flagged);
  const std::string corrections = CorrectionsText(s.rig);
  if (!corrections.empty()) table += Line("rig", "corrected " + corrections + "; see rig.yaml");
  std::string speed = FormatText("%.1f x real time", s.RealTimeFactor());
  // Nothing where there is too little data to tell.
  if (s.median_ms > 0.0) {
    speed += FormatText("; per second of data: median %.0f ms, 95 %% within %.0f ms", s.median_ms,
                        s.p95_ms);
  }
  table += Line("speed", speed);
  const std::string stages = Stages(s.windows);
  if (!stages.empty()) table += Line("", stages);
  table += Line("memory", FormatText("%.0f MB at most; ", s.peak_memory_mb) +
                              CountOf(s.map_points, "point") + " in the map");
  if (!s.warnings.empty()) {
    table += Line("warnings", FormatText("%zu, listed in run.json", s.warnings.size()));
  }
  if (s.lost_at_ns) table += Line("LOST", "at " + FormatSeconds(*s.lost_at_ns) + " s");
  table += Line("result", s.exit_reason + " (exit code " + std::to_string(s.exit_code.value_or(0)) +
                              "), in " + s.output);
  return table;
}

}  // namespace trajlo
