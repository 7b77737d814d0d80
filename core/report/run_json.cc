// SPDX-License-Identifier: MIT
#include "core/report/run_json.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/io/atomic_file.h"
#include "core/io/stamp_text.h"
#include "core/report/versions.h"

namespace trajlo {
namespace {

using Json = nlohmann::ordered_json;

/// Seconds as text: a double would lose nanoseconds of times since 1970.
Json SecondsOrNull(const std::optional<std::int64_t>& t_ns) {
  return t_ns ? Json(FormatSeconds(*t_ns)) : Json(nullptr);
}

Json VersionsJson() {
  const Versions v = GetVersions();
  return {{"trajlo", v.trajlo},
          {"git", v.git},
          {"eigen", v.eigen},
          {"ceres", v.ceres},
          {"compiler", v.compiler}};
}

/// So that the recording is found from other folders, too.
std::vector<std::string> Absolute(const std::vector<std::string>& paths) {
  std::vector<std::string> absolute;
  for (const std::string& path : paths) {
    std::error_code error;
    const std::filesystem::path whole = std::filesystem::absolute(path, error);
    absolute.push_back(error ? path : whole.lexically_normal().string());
  }
  return absolute;
}

Json InputJson(const RunSummary& s) {
  return {{"paths", s.inputs},
          {"absolute_paths", Absolute(s.inputs)},
          {"understood_as", s.input_description},
          {"scans",
           {{"listed", s.read.scans_listed},
            {"read", s.read.scans_read},
            {"damaged", s.read.scans_damaged},
            {"skipped", s.read.scans_skipped},
            {"left_out", s.read.scans_left_out},
            {"reordered", s.times.reordered},
            {"retimed", s.times.retimed},
            {"time_assumed", s.times.assumed},
            {"moved_with_the_clock", s.times.moved},
            {"stamp_fits_nowhere", s.times.misfits},
            {"stamp_repeated", s.times.repeated},
            {"points_repeated", s.times.stuck},
            {"clock_apart", s.times.apart},
            {"points_exchanged", s.times.exchanged},
            {"odd_point_times", s.times.odd_point_times},
            {"unseen_at_the_start", s.times.before_first_pose},
            {"unseen_at_the_end", s.times.Unseen()}}},
          {"topics_without_messages", s.read.topics_without_messages},
          {"clock_steps", s.times.clock_steps},
          {"points",
           {{"received", s.points.received},
            {"kept", s.points.Kept()},
            {"not_finite", s.NotFinite()},
            {"too_near", s.points.too_near},
            {"too_far", s.points.too_far},
            {"too_late", s.points.too_late},
            {"wrong_time", s.points.wrong_time},
            {"without_time", s.read.points_without_time},
            {"undeclared", s.read.points_undeclared}}}};
}

Json FlaggedJson(const PoseFlags& flags) {
  Json json = Json::object();
  for (const auto& [name, total] : flags.totals()) {
    json[name] = {
        {"poses", total.poses}, {"seconds", total.seconds}, {"longest_s", total.longest_s}};
  }
  return json;
}

const char* EvidenceName(RigEvidence evidence) {
  switch (evidence) {
    case RigEvidence::kContradicted:
      return "contradicted";
    case RigEvidence::kNotYet:
      return "not_yet";
    case RigEvidence::kNone:
      return "none";
    case RigEvidence::kConfirmed:
      return "confirmed";
  }
  return "";
}

Json RigJson(const std::vector<LidarPlace>& rig) {
  Json json = Json::array();
  for (const LidarPlace& place : rig) {
    const SE3& T = place.T_body_lidar;
    json.push_back({{"lidar", place.lidar},
                    {"T_body_lidar",
                     {{"translation_m", {T.t.x(), T.t.y(), T.t.z()}},
                      {"rotation", {T.q.x(), T.q.y(), T.q.z(), T.q.w()}}}},
                    {"clock_offset_s", place.clock_offset_s},
                    {"moved_m", place.moved_m},
                    {"turned_rad", place.turned_rad},
                    {"clock_moved_s", place.clock_moved_s},
                    {"evidence", EvidenceName(place.evidence)}});
  }
  return json;
}

Json ResultJson(const RunSummary& s) {
  return {{"begin_s", SecondsOrNull(s.begin_ns)},
          {"end_s", SecondsOrNull(s.end_ns)},
          {"duration_s", s.DataSeconds()},
          {"poses_written", s.poses_written},
          {"poses_flagged", s.flags.any().poses},
          {"flagged", FlaggedJson(s.flags)},
          {"path_length_m", s.path_length_m},
          {"distance_to_start_m", s.distance_to_start_m},
          {"lost_at_s", SecondsOrNull(s.lost_at_ns)},
          {"map_points", s.map_points},
          {"rig", RigJson(s.rig)}};
}

Json WindowsJson(const WindowTotals& w) {
  return {{"count", w.windows},
          {"points_mean", w.Mean(w.points)},
          {"inlier_share", w.InlierShare()},
          {"map_queries_mean", w.Mean(w.searched)},
          {"rounds_mean", w.Mean(w.rounds)},
          {"iterations_mean", w.Mean(w.iterations)},
          {"flagged", w.flags}};
}

Json ResourcesJson(const RunSummary& s) {
  return {{"wall_s", s.wall_s},
          {"cpu_s", s.cpu_s},
          {"real_time_factor", s.RealTimeFactor()},
          {"estimation_wall_s", s.estimation_s},
          {"estimation_ms_per_data_second", {{"median", s.median_ms}, {"p95", s.p95_ms}}},
          {"stages_ms",
           {{"segment", s.windows.segment_ms},
            {"associate", s.windows.associate_ms},
            {"solve", s.windows.solve_ms},
            {"marginalize", s.windows.marginalize_ms},
            {"map", s.windows.map_ms}}},
          {"peak_memory_mb", s.peak_memory_mb}};
}

}  // namespace

std::string RunJson(const RunSummary& s) {
  const Json json = {
      {"exit",
       {{"code", s.exit_code ? Json(*s.exit_code) : Json(nullptr)},
        {"reason", s.exit_reason},
        {"message", s.message}}},
      {"versions", VersionsJson()},
      {"command_line", s.command_line},
      {"output", s.output},
      {"solver", s.solver},
      {"threads", s.threads},
      {"input", InputJson(s)},
      {"result", ResultJson(s)},
      {"windows", WindowsJson(s.windows)},
      {"warnings", s.warnings},
      {"resources", ResourcesJson(s)},
  };
  // Paths need not be UTF-8; such bytes are replaced rather than thrown at the user.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void WriteRunJson(const std::filesystem::path& path, const RunSummary& summary) {
  WriteTextFile(path, RunJson(summary), IfExists::kReplace);
}

}  // namespace trajlo
