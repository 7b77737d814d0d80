// SPDX-License-Identifier: MIT
#include "apps/require_extrinsics.h"

#include <algorithm>
#include <cstddef>

#include "apps/usage_error.h"
#include "core/io/recording/open_clouds.h"
#include "core/io/recording/open_recording.h"

namespace trajlo {
namespace {

std::string Count(std::size_t lidars) {
  return lidars == 1 ? "one LiDAR is read" : std::to_string(lidars) + " LiDARs are read";
}

[[noreturn]] void FailTooMany(const std::vector<std::string>& lidars, std::size_t given) {
  std::string text = Count(lidars.size()) + ", but sensor.T_body_lidar has the poses of " +
                     std::to_string(given) + ":";
  for (const std::string& name : lidars) text += "\n      " + name;
  throw UsageError(text +
                   "\nName the LiDARs that are meant (topics of a bag with input.topics), or leave "
                   "in sensor.T_body_lidar those that are read, in this order.");
}

template <typename T>
void RequireOneForEach(const char* key, const PerLidar<T>& option, std::size_t lidars) {
  const std::size_t given = option.values.size();
  if (given == 1 || given == lidars) return;
  throw UsageError(std::string(key) + " has " + std::to_string(given) + " values, and " +
                   Count(lidars) + ": give one value for all, or one for each");
}

}  // namespace

void RequireOptionsOfEachLidar(const std::vector<std::string>& inputs,
                               const RecordingOptions& options) {
  const std::size_t lidars = LidarNames(inputs, options).size();
  RequireOneForEach("input.point_time", options.use_point_times, lidars);
  RequireOneForEach("input.time_field", options.time_field, lidars);
  RequireOneForEach("input.time_unit", options.time_unit, lidars);
  RequireOneForEach("input.time_origin", options.time_origin, lidars);
  RequireOneForEach("input.stamp_at", options.stamp_at, lidars);
  RequireOneForEach("input.clock_offset_s", options.clock_offset_s, lidars);
  if (!options.stamps_file.empty() && std::any_of(inputs.begin(), inputs.end(), HoldsClouds)) {
    throw UsageError(
        "input.stamps_file is for folders of scans; a recording with messages has the "
        "stamps of these");
  }
  if (!options.stamps_file.empty() && lidars > 1) {
    throw UsageError("input.stamps_file: " + Count(lidars) +
                     ", and one file cannot have the stamps of all; put a timestamps.txt into each "
                     "folder");
  }
}

void RequireExtrinsics(const std::vector<std::string>& inputs, const RunConfig& config) {
  const std::vector<std::string> lidars = LidarNames(inputs, config.input);
  const std::size_t given = config.odometry.segmenter.T_body_lidar.size();
  if (given > lidars.size()) FailTooMany(lidars, given);
  if (lidars.size() < 2 || given == lidars.size()) return;
  std::string text = std::to_string(lidars.size()) + " LiDARs are read, and sensor.T_body_lidar " +
                     (given == 0 ? "is empty" : "has " + std::to_string(given)) +
                     ": it needs the pose of each in the body frame, in this order. In a file for "
                     "--config:\n  sensor:\n    T_body_lidar:\n";
  for (const std::string& name : lidars) {
    text += "      - {translation_m: [x, y, z], rotation: [qx, qy, qz, qw]}  # " + name + "\n";
  }
  std::string identities = "{}";
  for (std::size_t i = 1; i < lidars.size(); ++i) identities += ", {}";
  throw UsageError(text + "or, where they all sit in the body's origin, " +
                   "'--set=sensor.T_body_lidar=[" + identities + "]'");
}

}  // namespace trajlo
