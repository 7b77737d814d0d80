// SPDX-License-Identifier: MIT
#include "apps/info/info_table.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/io/format_text.h"
#include "core/io/inspection/findings.h"
#include "core/io/inspection/run_advice.h"
#include "core/io/stamp_text.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

constexpr std::size_t kPrintedGaps = 5;
constexpr std::size_t kPrintedWarnings = 20;

std::string Line(const char* label, const std::string& text) {
  return FormatText("  %-10s", label) + text + "\n";
}

/// "1.23 %", and for what is rarer or more frequent than that can say "<0.01 %" or ">99.99 %".
std::string Percent(std::size_t part, std::size_t whole) {
  if (part == 0 || whole == 0) return "0 %";
  if (part == whole) return "100 %";
  const double percent = 100.0 * static_cast<double>(part) / static_cast<double>(whole);
  if (percent < 0.01) return "<0.01 %";
  return percent > 99.99 ? ">99.99 %" : FormatText("%.2f %%", percent);
}

std::string Milliseconds(double seconds) { return FormatText("%.4g ms", 1e3 * seconds); }

/// "100 ms before" or "2 ms after"
std::string Displacement(double after_s) {
  return Milliseconds(std::abs(after_s)) + (after_s < 0.0 ? " before" : " after");
}

std::string TopicTable(const RecordingInspection& recording) {
  std::size_t name_width = 5, type_width = 4;
  for (const Topic& topic : recording.topics) {
    name_width = std::max(name_width, topic.name.size());
    type_width = std::max(type_width, topic.type.size());
  }
  const auto row = [&](const std::string& name, const std::string& type,
                       const std::string& messages, const std::string& rate) {
    std::string line = "  " + name + std::string(name_width - name.size() + 2, ' ') + type +
                       std::string(type_width - type.size() + 2, ' ');
    return line + FormatText("%9s  %9s\n", messages.c_str(), rate.c_str());
  };
  std::string table = row("topic", "type", "messages", "rate");
  for (const Topic& topic : recording.topics) {
    std::string rate = "-";
    const auto cloud =
        std::find_if(recording.clouds.begin(), recording.clouds.end(),
                     [&](const CloudInspection& one) { return one.topic == topic.name; });
    if (cloud != recording.clouds.end()) {
      if (cloud->stamps.period_s > 0.0) rate = FormatText("%.4g Hz", 1.0 / cloud->stamps.period_s);
    } else if (recording.duration_s > 0.0 && !recording.is_quick && topic.messages > 1) {
      rate = FormatText("~%.3g Hz", static_cast<double>(topic.messages) / recording.duration_s);
    }
    table += row(topic.name, topic.type, std::to_string(topic.messages), rate);
  }
  return table;
}

std::string FieldText(const CloudInspection& cloud) {
  std::string text;
  for (const FieldDescription& field : cloud.fields) {
    text += (text.empty() ? "" : ", ") + field.name + " " + field.type + " @" +
            std::to_string(field.offset);
  }
  return text;
}

std::string PointLines(const PointSummary& points) {
  std::string lines =
      Line("points", FormatText("%zu per message (%zu to %zu), %zu in all, ", points.median,
                                points.fewest, points.most, points.total) +
                         Percent(points.not_finite, points.total) + " NaN, " +
                         Percent(points.at_origin, points.total) + " at the origin");
  if (points.Returns() > 0) {
    lines += Line("ranges", FormatText("%.2f to %.2f m, median %.2f m, 99 %% below %.2f m",
                                       points.range_min_m, points.range_max_m,
                                       points.range_median_m, points.range_99_m));
    lines += Line("elevation", FormatText("98 %% of the points are from %.1f to %.1f degrees",
                                          points.elevation_1_deg, points.elevation_99_deg));
  }
  if (points.rings) {
    lines += Line("rings", FormatText("%zu, from %u to %u", points.rings->distinct,
                                      points.rings->lowest, points.rings->highest));
  }
  return lines;
}

std::string StampLines(const StampSummary& stamps) {
  if (stamps.count == 0) return Line("stamps", "none");
  std::string lines =
      Line("stamps", FormatSeconds(stamps.first_ns) + " to " + FormatSeconds(stamps.last_ns) +
                         FormatText(" s, every %.6g s, jitter %.2g s, at most %.2g s",
                                    stamps.period_s, stamps.jitter_s, stamps.largest_deviation_s));
  for (std::size_t i = 0; i < stamps.gaps.size() && i < kPrintedGaps; ++i) {
    lines += Line("", FormatText("gap of %.4g s after ", Seconds(stamps.gaps[i].length_ns)) +
                          FormatSeconds(stamps.gaps[i].after_ns) + " s");
  }
  if (stamps.gaps.size() > kPrintedGaps) {
    lines += Line("", "and " + CountOf(stamps.gaps.size() - kPrintedGaps, "more gap") +
                          " (--json lists all)");
  }
  if (const auto& delay = stamps.recorded_after_s) {
    lines += Line("recorded", FormatText("%.4g s after the stamp (%.4g to %.4g s)", delay->median,
                                         delay->least, delay->most));
  }
  return lines;
}

/// The evidence comes as clauses with semicolons between them: a line each.
std::string EvidenceLines(const std::string& evidence) {
  std::string lines;
  std::size_t begin = 0;
  while (begin < evidence.size()) {
    const std::size_t end = std::min(evidence.find("; ", begin), evidence.size());
    lines += Line("", "- " + evidence.substr(begin, end - begin));
    begin = end + 2;
  }
  return lines;
}

std::string TimeLines(const CloudInspection& cloud) {
  if (!cloud.time_problem.empty()) return Line("times", "not decided, see below");
  const TimeConvention& convention = cloud.convention;
  if (!convention.HasPointTimes()) return Line("times", convention.evidence);
  const bool at_end = convention.stamp_at == StampAt::kEnd;
  std::string meaning = "field '" + convention.field + "' in " + NameOf(convention.unit) + ", ";
  switch (convention.origin) {
    case TimeOrigin::kSweepStart:
      meaning += "from the start of the sweep; stamps mark its ";
      meaning += at_end ? "end" : "start";
      break;
    case TimeOrigin::kSweepEnd:
      meaning += "from the end of the sweep; stamps mark its ";
      meaning += at_end ? "end" : "start";
      break;
    case TimeOrigin::kStamp:
      meaning += "from the stamp, inside the sweep";
      break;
    default:
      meaning += "absolute";
  }
  std::string lines = Line("times", meaning) + EvidenceLines(convention.evidence);
  if (cloud.sweeps) {
    lines += Line("sweeps",
                  Milliseconds(cloud.sweeps->span_s) + " long, " +
                      Milliseconds(cloud.sweeps->pause_s) + " from one to the next; the stamp is " +
                      Displacement(cloud.sweeps->stamp_after_first_s) + " the first point and " +
                      Displacement(cloud.sweeps->stamp_after_last_s) + " the last");
  }
  return lines;
}

std::string CloudBlock(const CloudInspection& cloud, std::size_t lidar) {
  std::string block = "\nlidar " + std::to_string(lidar) + ": " + cloud.topic + "\n";
  std::string frames;
  for (const std::string& frame : cloud.frame_ids) frames += (frames.empty() ? "" : ", ") + frame;
  if (!frames.empty()) block += Line("frame", frames);
  if (!cloud.remark.empty()) block += Line("packets", cloud.remark);
  block += Line("fields", FieldText(cloud));
  block += PointLines(cloud.points) + StampLines(cloud.stamps) + TimeLines(cloud);
  if (cloud.phase) {
    block += Line("phase", "sweeps begin " + Milliseconds(cloud.phase->after_first_lidar_s) +
                               " after those of lidar 0 (varies by " +
                               Milliseconds(cloud.phase->spread_s) + ")");
  }
  for (const std::string& finding : FindingsOf(cloud)) block += "  ! " + finding + "\n";
  return block;
}

}  // namespace

std::string InfoTable(const RecordingInspection& recording, const std::string& program_folder) {
  std::string table = recording.path + ": " + FormatText("%.3f s, ", recording.duration_s) +
                      CountOf(recording.topics.size(), "topic") +
                      (recording.is_quick ? ", of which the first messages were read\n" : "\n");
  table += TopicTable(recording);
  for (std::size_t i = 0; i < recording.clouds.size(); ++i) {
    table += CloudBlock(recording.clouds[i], i);
  }
  if (!recording.warnings.empty()) table += "\n";
  for (std::size_t i = 0; i < recording.warnings.size() && i < kPrintedWarnings; ++i) {
    table += "  ! " + recording.warnings[i] + "\n";
  }
  if (recording.damaged) {
    table += "  ! damaged: everything that can be read is shown" +
             (recording.bytes_lost > 0 ? " (" + CountOf(recording.bytes_lost, "byte") + " lost)"
                                       : std::string()) +
             "\n";
  }
  const RunAdvice advice = AdviseRun(recording);
  if (advice.command.empty()) {
    return table + (recording.clouds.empty() ? "\nno point clouds" : "\nno cloud has a point") +
           ": there is nothing to run on\n";
  }
  table += "\nto run on it:\n  " + program_folder + advice.command + "\n";
  for (const std::string& remark : advice.remarks) table += "  - " + remark + "\n";
  return table;
}

}  // namespace trajlo
