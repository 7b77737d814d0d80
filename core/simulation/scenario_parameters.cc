// SPDX-License-Identifier: MIT
#include "core/simulation/scenario_parameters.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "core/config/edit_distance.h"

namespace trajlo::simulation {

namespace {

std::vector<Parameter> LidarParameters(const std::string& prefix, LidarConfig* lidar) {
  MeasurementModel& m = lidar->measurement;
  return {{prefix + "sensor", &lidar->sensor},
          {prefix + "columns", &lidar->columns},
          {prefix + "T_body_lidar", &lidar->T_body_lidar},
          {prefix + "phase_s", &lidar->phase_s},
          {prefix + "clock_offset_s", &lidar->clock_offset_s},
          {prefix + "range_sigma_m", &m.range_sigma_m},
          {prefix + "angle_sigma_rad", &m.angle_sigma_rad},
          {prefix + "dropout_fraction", &m.dropout_fraction},
          {prefix + "min_range_m", &m.min_range_m},
          {prefix + "max_range_m", &m.max_range_m}};
}

[[noreturn]] void ThrowUnreadable(const std::string& text, const std::string& expected) {
  throw std::invalid_argument("'" + text + "' is not " + expected);
}

double ParseDouble(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') ThrowUnreadable(text, "a number");
  return value;
}

long long ParseInteger(const std::string& text) {
  char* end = nullptr;
  const long long value = std::strtoll(text.c_str(), &end, 10);
  if (text.empty() || *end != '\0') ThrowUnreadable(text, "a whole number");
  return value;
}

SE3 ParsePose(const std::string& text) {
  std::vector<double> v;
  std::istringstream stream(text);
  for (std::string field; std::getline(stream, field, ',');) v.push_back(ParseDouble(field));
  if (v.size() != 7) ThrowUnreadable(text, "a pose x,y,z,qx,qy,qz,qw");
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (!(q.norm() > 0.5)) ThrowUnreadable(text, "a pose with a unit quaternion");
  return {q.normalized(), {v[0], v[1], v[2]}};
}

struct Assign {
  const std::string& text;
  void operator()(double* value) const { *value = ParseDouble(text); }
  void operator()(int* value) const { *value = static_cast<int>(ParseInteger(text)); }
  void operator()(std::int64_t* value) const { *value = ParseInteger(text); }
  void operator()(std::uint64_t* value) const {
    *value = static_cast<std::uint64_t>(ParseInteger(text));
  }
  void operator()(std::string* value) const { *value = text; }
  void operator()(SE3* value) const { *value = ParsePose(text); }
  void operator()(bool* value) const {
    if (text != "true" && text != "false") ThrowUnreadable(text, "true or false");
    *value = text == "true";
  }
};

/// The shortest text that reads back as the same double.
std::string ShortestText(double value) {
  char text[40];
  for (int digits = 6; digits <= 17; ++digits) {
    std::snprintf(text, sizeof(text), "%.*g", digits, value);
    if (std::strtod(text, nullptr) == value) break;
  }
  return text;
}

struct Format {
  std::string operator()(const double* value) const { return ShortestText(*value); }
  std::string operator()(const int* value) const { return std::to_string(*value); }
  std::string operator()(const std::int64_t* value) const { return std::to_string(*value); }
  std::string operator()(const std::uint64_t* value) const { return std::to_string(*value); }
  std::string operator()(const std::string* value) const { return *value; }
  std::string operator()(const bool* value) const { return *value ? "true" : "false"; }
  std::string operator()(const SE3* value) const {
    const Eigen::Vector3d& t = value->t;
    const Eigen::Quaterniond& q = value->q;
    std::string text;
    for (const double v : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
      text += (text.empty() ? "" : ",") + ShortestText(v);
    }
    return text;
  }
};

}  // namespace

std::vector<Parameter> Parameters(Scenario* s) {
  MotionConfig& m = s->motion;
  FaultConfig& f = s->faults;
  std::vector<Parameter> parameters = {
      {"duration_s", &s->duration_s},
      {"start_time_ns", &s->start_time_ns},
      {"seed", &s->seed},
      {"scene", &s->scene},
      {"moving_objects", &s->moving_objects},
      {"motion_corrected", &s->motion_corrected},
      {"motion.kind", &m.kind},
      {"motion.rest_s", &m.rest_s},
      {"motion.moving_start", &m.moving_start},
      {"motion.speed_mps", &m.speed_mps},
      {"motion.unevenness", &m.unevenness},
      {"motion.acceleration_mps2", &m.acceleration_mps2},
      {"motion.cruise_s", &m.cruise_s},
      {"motion.braking_mps2", &m.braking_mps2},
      {"motion.stop_s", &m.stop_s},
      {"motion.height_m", &m.height_m},
      {"motion.shake", &m.shake},
      {"motion.max_tilt_deg", &m.max_tilt_deg},
      {"motion.climb_s", &m.climb_s},
      {"motion.landing", &m.landing},
      {"motion.turn_rate_rad_s", &m.turn_rate_rad_s},
      {"motion.rope_m", &m.rope_m},
      {"motion.swing_deg", &m.swing_deg},
      {"motion.swing_hz", &m.swing_hz},
      {"motion.burst_deg", &m.burst_deg},
      {"motion.burst_every_s", &m.burst_every_s},
      {"motion.glance_s", &m.glance_s},
      {"motion.replay_file", &m.replay_file},
      {"motion.replay_placed", &m.replay_placed},
      {"faults.dropped_scan_fraction", &f.dropped_scan_fraction},
      {"faults.repeated_scan_fraction", &f.repeated_scan_fraction},
      {"faults.nan_point_fraction", &f.nan_point_fraction},
      {"faults.duplicate_stamp_fraction", &f.duplicate_stamp_fraction},
      {"faults.backward_stamp_fraction", &f.backward_stamp_fraction},
      {"faults.backward_step_s", &f.backward_step_s},
      {"faults.stamp_jitter_s", &f.stamp_jitter_s},
      {"faults.silent_lidar", &f.silent_lidar},
      {"faults.silent_from_s", &f.silent_from_s},
      {"faults.silent_until_s", &f.silent_until_s},
      {"faults.pause_from_s", &f.pause_from_s},
      {"faults.pause_s", &f.pause_s},
      {"faults.cover_from_s", &f.cover_from_s},
      {"faults.cover_s", &f.cover_s},
      {"faults.cover_m", &f.cover_m},
      {"faults.end_of_sweep_stamps", &f.end_of_sweep_stamps},
  };
  for (std::size_t id = 0; id < s->rig.size(); ++id) {
    const std::vector<Parameter> lidar =
        LidarParameters("lidar" + std::to_string(id) + ".", &s->rig[id]);
    parameters.insert(parameters.end(), lidar.begin(), lidar.end());
  }
  return parameters;
}

void SetParameter(Scenario* scenario, const std::string& key, const std::string& text) {
  constexpr char kAllLidars[] = "lidar.";
  if (key.rfind(kAllLidars, 0) == 0) {
    for (std::size_t id = 0; id < scenario->rig.size(); ++id) {
      SetParameter(scenario, "lidar" + std::to_string(id) + key.substr(5), text);
    }
    return;
  }
  const Parameter* nearest = nullptr;
  int nearest_distance = 0;
  const std::vector<Parameter> parameters = Parameters(scenario);
  for (const Parameter& parameter : parameters) {
    if (parameter.key == key) {
      try {
        std::visit(Assign{text}, parameter.value);
        for (LidarConfig& lidar : scenario->rig) {
          if (parameter.value == Parameter{"", &lidar.sensor}.value) {
            lidar.measurement = MakeSensor(lidar.sensor, lidar.columns).measurement;
          }
        }
      } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(key + ": " + error.what());
      }
      return;
    }
    // A key cut short counts as near as well: 'motion.sped' means motion.speed_mps.
    const int distance = std::min(EditDistance(key, parameter.key),
                                  EditDistance(key, parameter.key.substr(0, key.size())) + 1);
    if (nearest == nullptr || distance < nearest_distance) {
      nearest = &parameter;
      nearest_distance = distance;
    }
  }
  throw std::invalid_argument("there is no parameter '" + key + "'; did you mean '" + nearest->key +
                              "'?");
}

std::string ParameterText(const Parameter& parameter) {
  return std::visit(Format{}, parameter.value);
}

}  // namespace trajlo::simulation
