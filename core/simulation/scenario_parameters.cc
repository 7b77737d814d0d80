// SPDX-License-Identifier: MIT
#include "core/simulation/scenario_parameters.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include "core/io/format_text.h"
#include "core/io/number_text.h"
#include "core/options/did_you_mean.h"
#include "core/options/edit_distance.h"
#include "core/simulation/scenes/scene_builder.h"

namespace trajlo::simulation {

namespace {

using Real = Bounded<double>;
using Whole = Bounded<int>;

// Bounds keep out what is certainly a mistake, and what would not fit into a stamp.
constexpr double kLongest_s = 1e6;
constexpr double kFarthest_m = 1e6;
constexpr int kMostColumns = 100'000;
constexpr std::int64_t kEndOfTime_ns = 4'000'000'000'000'000'000;

Real Share(double* value) { return {value, 0.0, 1.0}; }
/// A time or a size that is not negative.
Real Seconds(double* value) { return {value, 0.0, kLongest_s}; }
Real Metres(double* value) { return {value, 0.0, kFarthest_m}; }

std::vector<Parameter> LidarParameters(const std::string& prefix, LidarConfig* lidar) {
  MeasurementModel& m = lidar->measurement;
  return {{prefix + "sensor", Word{&lidar->sensor, SensorNames()}},
          {prefix + "columns", Whole{&lidar->columns, 0, kMostColumns}},
          {prefix + "T_body_lidar", &lidar->T_body_lidar},
          {prefix + "phase_s", Real{&lidar->phase_s, -kLongest_s, kLongest_s}},
          {prefix + "clock_offset_s", Real{&lidar->clock_offset_s, -1e9, 1e9}},
          {prefix + "range_sigma_m", Metres(&m.range_sigma_m)},
          {prefix + "angle_sigma_rad", Real{&m.angle_sigma_rad, 0.0, 3.0}},
          {prefix + "dropout_fraction", Share(&m.dropout_fraction)},
          {prefix + "clutter_fraction", Share(&m.clutter_fraction)},
          {prefix + "clutter_range_m", Metres(&m.clutter_range_m)},
          {prefix + "min_range_m", Metres(&m.min_range_m)},
          {prefix + "max_range_m", Metres(&m.max_range_m)},
          {prefix + "laser_range_sigma_m", Metres(&m.laser_range_sigma_m)},
          {prefix + "laser_angle_sigma_rad", Real{&m.laser_angle_sigma_rad, 0.0, 1.0}},
          {prefix + "divergence_rad", Real{&m.divergence_rad, 0.0, 1.0}}};
}

/// The shortest text that reads back as the same double.
std::string ShortestText(double value) {
  std::string text;
  for (int digits = 6; digits <= 17; ++digits) {
    text = FormatText("%.*g", digits, value);
    if (std::strtod(text.c_str(), nullptr) == value) break;
  }
  return text;
}

std::string Text(double value) { return ShortestText(value); }
template <typename Integer>
std::string Text(Integer value) {
  return std::to_string(value);
}

[[noreturn]] void ThrowUnreadable(const std::string& text, const std::string& expected) {
  throw std::invalid_argument("'" + text + "' is not " + expected);
}

/// The whole text but for blanks before it, whatever the locale.
template <typename T>
bool Parse(std::string_view text, T* value) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  return ParseNumber(text, value);
}

SE3 ParsePose(const std::string& text) {
  std::vector<double> v;
  std::istringstream stream(text);
  for (std::string field; std::getline(stream, field, ',');) {
    double number = 0.0;
    if (!Parse(field, &number) || !(std::abs(number) <= kFarthest_m)) {
      ThrowUnreadable(field, "a number from " + Text(-kFarthest_m) + " to " + Text(kFarthest_m));
    }
    v.push_back(number);
  }
  if (v.size() != 7) ThrowUnreadable(text, "a pose x,y,z,qx,qy,qz,qw");
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (!(q.norm() > 0.5)) ThrowUnreadable(text, "a pose with a unit quaternion");
  return {q.normalized(), {v[0], v[1], v[2]}};
}

struct Assign {
  const std::string& text;

  template <typename T>
  void operator()(const Bounded<T>& number) const {
    T value{};
    if (Parse(text, &value) && value >= number.least && value <= number.greatest) {
      *number.value = value;
      return;
    }
    const char* kind = std::is_integral_v<T> ? "a whole number" : "a number";
    ThrowUnreadable(
        text, std::string(kind) + " from " + Text(number.least) + " to " + Text(number.greatest));
  }
  void operator()(const Word& word) const {
    const std::vector<std::string>& choices = word.choices;
    if (!choices.empty() && std::find(choices.begin(), choices.end(), text) == choices.end()) {
      std::string names;
      for (const std::string& name : choices) names += (names.empty() ? "" : ", ") + name;
      ThrowUnreadable(text, "one of " + names);
    }
    *word.value = text;
  }
  void operator()(SE3* value) const { *value = ParsePose(text); }
  void operator()(bool* value) const {
    if (text != "true" && text != "false") ThrowUnreadable(text, "true or false");
    *value = text == "true";
  }
};

struct Format {
  template <typename T>
  std::string operator()(const Bounded<T>& number) const {
    return Text(*number.value);
  }
  std::string operator()(const Word& word) const { return *word.value; }
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

[[noreturn]] void ThrowUnknown(const std::string& key, const std::vector<Parameter>& parameters) {
  std::vector<std::string> keys;
  for (const Parameter& parameter : parameters) keys.push_back(parameter.key);
  const std::string mend = Suggestion(NearestOrLonger(key, keys));
  throw std::invalid_argument(
      "there is no parameter '" + key + "'" +
      (mend.empty() ? "; trajlo_simulate --list_parameters shows all of them" : mend));
}

}  // namespace

std::vector<Parameter> Parameters(Scenario* s) {
  MotionConfig& m = s->motion;
  CompanionConfig& c = s->companion;
  FaultConfig& f = s->faults;
  std::vector<Parameter> parameters = {
      {"duration_s", Real{&s->duration_s, kShortestDuration_s, kLongestDuration_s}},
      {"start_time_ns", Bounded<std::int64_t>{&s->start_time_ns, -kEndOfTime_ns, kEndOfTime_ns}},
      {"seed", Bounded<std::uint64_t>{&s->seed, 0, std::numeric_limits<std::uint64_t>::max()}},
      {"scene", Word{&s->scene, SceneNames()}},
      {"moving_objects", &s->moving_objects},
      {"motion_corrected", &s->motion_corrected},
      {"motion.kind", Word{&m.kind, MotionKinds()}},
      {"motion.rest_s", Seconds(&m.rest_s)},
      {"motion.moving_start", &m.moving_start},
      {"motion.speed_mps", Real{&m.speed_mps, -1000.0, 1000.0}},
      {"motion.unevenness", Share(&m.unevenness)},
      {"motion.acceleration_mps2", Real{&m.acceleration_mps2, 0.0, 1000.0}},
      {"motion.cruise_s", Seconds(&m.cruise_s)},
      {"motion.braking_mps2", Real{&m.braking_mps2, 0.0, 1000.0}},
      {"motion.stop_s", Seconds(&m.stop_s)},
      {"motion.height_m", Real{&m.height_m, -1000.0, 1000.0}},
      {"motion.shake", Real{&m.shake, 0.0, 1000.0}},
      {"motion.max_tilt_deg", Real{&m.max_tilt_deg, 0.1, 90.0}},
      {"motion.raised_m", Real{&m.raised_m, 0.0, 1000.0}},
      {"motion.climb_s", Seconds(&m.climb_s)},
      {"motion.landing", &m.landing},
      {"motion.turn_rate_rad_s", Real{&m.turn_rate_rad_s, -1000.0, 1000.0}},
      {"motion.rope_m", Real{&m.rope_m, 0.0, 1000.0}},
      {"motion.swing_deg", Real{&m.swing_deg, -360.0, 360.0}},
      {"motion.swing_hz", Real{&m.swing_hz, 0.0, 1000.0}},
      {"motion.burst_deg", Real{&m.burst_deg, -360.0, 360.0}},
      {"motion.burst_every_s", Real{&m.burst_every_s, 0.001, kLongest_s}},
      {"motion.glance_s", Real{&m.glance_s, 0.001, kLongest_s}},
      {"motion.replay_file", Word{&m.replay_file, {}}},
      {"motion.replay_placed", &m.replay_placed},
      {"companion.kind", Word{&c.kind, CompanionKinds()}},
      {"companion.ahead_m", Real{&c.ahead_m, -kFarthest_m, kFarthest_m}},
      {"companion.left_m", Real{&c.left_m, -kFarthest_m, kFarthest_m}},
      {"companion.below_m", Real{&c.below_m, -kFarthest_m, kFarthest_m}},
      {"companion.sway_m", Metres(&c.sway_m)},
      {"companion.sway_hz", Real{&c.sway_hz, 0.0, 1000.0}},
      {"faults.dropped_scan_fraction", Share(&f.dropped_scan_fraction)},
      {"faults.repeated_scan_fraction", Share(&f.repeated_scan_fraction)},
      {"faults.nan_point_fraction", Share(&f.nan_point_fraction)},
      {"faults.duplicate_stamp_fraction", Share(&f.duplicate_stamp_fraction)},
      {"faults.backward_stamp_fraction", Share(&f.backward_stamp_fraction)},
      {"faults.backward_step_s", Seconds(&f.backward_step_s)},
      {"faults.stamp_jitter_s", Seconds(&f.stamp_jitter_s)},
      {"faults.silent_lidar", Whole{&f.silent_lidar, -1, static_cast<int>(s->rig.size()) - 1}},
      {"faults.silent_from_s", Seconds(&f.silent_from_s)},
      {"faults.silent_until_s", Seconds(&f.silent_until_s)},
      {"faults.pause_from_s", Seconds(&f.pause_from_s)},
      {"faults.pause_s", Seconds(&f.pause_s)},
      {"faults.cover_from_s", Seconds(&f.cover_from_s)},
      {"faults.cover_s", Seconds(&f.cover_s)},
      {"faults.cover_m", Metres(&f.cover_m)},
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
  const std::vector<Parameter> parameters = Parameters(scenario);
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const Parameter& one) { return one.key == key; });
  if (found == parameters.end()) ThrowUnknown(key, parameters);
  try {
    std::visit(Assign{text}, found->value);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(key + ": " + error.what());
  }
  const Word* word = std::get_if<Word>(&found->value);
  for (LidarConfig& lidar : scenario->rig) {
    if (word == nullptr || word->value != &lidar.sensor) continue;
    lidar.measurement = MakeSensor(lidar.sensor, lidar.columns).measurement;
  }
}

void SetParameters(Scenario* scenario, std::vector<std::pair<std::string, std::string>> settings) {
  std::stable_partition(settings.begin(), settings.end(), [](const auto& setting) {
    const std::string& key = setting.first;
    return key.substr(key.find('.') + 1) == "sensor";
  });
  for (const auto& [key, text] : settings) SetParameter(scenario, key, text);
}

std::string ParameterText(const Parameter& parameter) {
  return std::visit(Format{}, parameter.value);
}

std::vector<std::string> ChoicesOf(const Parameter& parameter) {
  if (std::holds_alternative<bool*>(parameter.value)) return {"true", "false"};
  const auto* word = std::get_if<Word>(&parameter.value);
  return word == nullptr ? std::vector<std::string>() : word->choices;
}

}  // namespace trajlo::simulation
