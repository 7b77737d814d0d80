// SPDX-License-Identifier: MIT
#include "apps/info/info_json.h"

#include <nlohmann/json.hpp>

#include "core/io/inspection/findings.h"
#include "core/io/inspection/run_advice.h"

namespace trajlo {
namespace {

using Json = nlohmann::ordered_json;

template <typename T>
Json OrNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json StampJson(const StampSummary& stamps) {
  Json json = {{"count", stamps.count},
               {"first_ns", stamps.first_ns},
               {"last_ns", stamps.last_ns},
               {"period_s", stamps.period_s},
               {"jitter_s", stamps.jitter_s},
               {"largest_deviation_s", stamps.largest_deviation_s},
               {"duplicates", stamps.duplicates},
               {"first_duplicate_ns", OrNull(stamps.first_duplicate_ns)},
               {"steps_back", stamps.steps_back},
               {"first_step_back_ns", OrNull(stamps.first_step_back_ns)},
               {"largest_step_back_s", stamps.largest_step_back_s},
               {"missing", stamps.missing},
               {"gaps", Json::array()},
               {"recorded_after_s", nullptr}};
  for (const StampGap& gap : stamps.gaps) {
    json["gaps"].push_back({{"after_ns", gap.after_ns}, {"length_ns", gap.length_ns}});
  }
  if (const auto& delay = stamps.recorded_after_s) {
    json["recorded_after_s"] = {
        {"least", delay->least}, {"median", delay->median}, {"most", delay->most}};
  }
  return json;
}

Json PointJson(const PointSummary& points) {
  Json json = {{"total", points.total},
               {"not_finite", points.not_finite},
               {"at_origin", points.at_origin},
               {"fewest", points.fewest},
               {"median", points.median},
               {"most", points.most},
               {"empty_messages", points.empty_messages},
               {"range_min_m", points.range_min_m},
               {"range_median_m", points.range_median_m},
               {"range_99_m", points.range_99_m},
               {"range_max_m", points.range_max_m},
               {"elevation_1_deg", points.elevation_1_deg},
               {"elevation_99_deg", points.elevation_99_deg},
               {"rings", nullptr}};
  if (points.rings) {
    json["rings"] = {{"distinct", points.rings->distinct},
                     {"lowest", points.rings->lowest},
                     {"highest", points.rings->highest}};
  }
  return json;
}

Json TimeJson(const CloudInspection& cloud) {
  const TimeConvention& convention = cloud.convention;
  Json json = {{"field", convention.field}, {"evidence", convention.evidence}};
  json["problem"] = cloud.time_problem;
  json["stamp_is_recorded"] = cloud.stamp_is_recorded;
  json["stamp_is_assumed"] = cloud.stamp_is_assumed;
  if (convention.HasPointTimes()) {
    json["unit"] = NameOf(convention.unit);
    json["origin"] = NameOf(convention.origin);
    json["stamp_at"] = convention.stamp_at == StampAt::kEnd ? "end" : "start";
    json["sweep_ns"] = convention.sweep_ns;
    json["clock_offset_ns"] = convention.clock_offset_ns;
  }
  if (cloud.sweeps) {
    json["sweeps"] = {{"span_s", cloud.sweeps->span_s},
                      {"pause_s", cloud.sweeps->pause_s},
                      {"stamp_after_first_s", cloud.sweeps->stamp_after_first_s},
                      {"stamp_after_last_s", cloud.sweeps->stamp_after_last_s},
                      {"points_without_time", cloud.sweeps->points_without_time}};
  }
  return json;
}

Json CloudJson(const CloudInspection& cloud) {
  Json json = {{"topic", cloud.topic},
               {"type", cloud.type},
               {"messages_listed", cloud.messages_listed},
               {"messages_read", cloud.messages_read},
               {"messages_unreadable", cloud.messages_unreadable},
               {"messages_damaged", cloud.messages_damaged},
               {"frame_ids", cloud.frame_ids},
               {"fields", Json::array()}};
  for (const FieldDescription& field : cloud.fields) {
    json["fields"].push_back(
        {{"name", field.name}, {"type", field.type}, {"offset", field.offset}});
  }
  json["stamps"] = StampJson(cloud.stamps);
  json["points"] = PointJson(cloud.points);
  json["times"] = TimeJson(cloud);
  if (cloud.phase) {
    json["phase"] = {{"after_first_lidar_s", cloud.phase->after_first_lidar_s},
                     {"spread_s", cloud.phase->spread_s}};
  }
  json["findings"] = FindingsOf(cloud);
  return json;
}

Json RecordingJson(const RecordingInspection& recording) {
  Json json = {{"path", recording.path},
               {"duration_s", recording.duration_s},
               {"quick", recording.is_quick},
               {"damaged", recording.damaged},
               {"bytes_lost", recording.bytes_lost},
               {"topics", Json::array()},
               {"lidars", Json::array()}};
  for (const Topic& topic : recording.topics) {
    json["topics"].push_back(
        {{"name", topic.name}, {"type", topic.type}, {"messages", topic.messages}});
  }
  for (const CloudInspection& cloud : recording.clouds) json["lidars"].push_back(CloudJson(cloud));
  json["warnings"] = recording.warnings;
  const RunAdvice advice = AdviseRun(recording);
  json["run"] = {
      {"command", advice.command}, {"config", advice.config}, {"remarks", advice.remarks}};
  return json;
}

}  // namespace

std::string InfoJson(const std::vector<RecordingInspection>& recordings) {
  Json json = {{"recordings", Json::array()}};
  for (const RecordingInspection& recording : recordings) {
    json["recordings"].push_back(RecordingJson(recording));
  }
  // Names from a broken file may hold anything.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace trajlo
