// SPDX-License-Identifier: MIT
#include "apps/require_extrinsics.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <set>

#include "apps/usage_error.h"
#include "core/io/format_text.h"
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

/// True for bags that are named alike but for numbers, as a recorder names the parts.
bool ArePartsOfOne(const std::vector<std::string>& inputs) {
  const auto without_digits = [](const std::string& path) {
    std::string text = std::filesystem::path(path).filename().string();
    text.erase(std::remove_if(text.begin(), text.end(),
                              [](unsigned char c) { return std::isdigit(c) != 0; }),
               text.end());
    return text;
  };
  return inputs.size() > 1 && std::all_of(inputs.begin(), inputs.end(), [&](const auto& input) {
           return std::filesystem::is_regular_file(input) &&
                  without_digits(input) == without_digits(inputs.front());
         });
}

/// The second would get no scan.
void RequireDifferentTopics(const RecordingOptions& options) {
  std::set<std::string> topics;
  for (const std::string& topic : options.topics) {
    if (topics.insert(topic).second) continue;
    throw UsageError("input.topics has '" + topic +
                     "' twice: each topic is one LiDAR. Name the topics that are meant, once each");
  }
}

template <typename T>
void RequireOneForEach(const char* key, const PerLidar<T>& option, std::size_t lidars) {
  const std::size_t given = option.values.size();
  if (given == 1 || given == lidars) return;
  throw UsageError(std::string(key) + " has " + CountOf(given, "value") + ", and " + Count(lidars) +
                   ": give one value for all, or one for each");
}

}  // namespace

void RequireOptionsOfEachLidar(const std::vector<std::string>& inputs,
                               const RecordingOptions& options) {
  RequireDifferentTopics(options);
  const std::size_t lidars = LidarNames(inputs, options).size();
  RequireOneForEach("input.point_time", options.use_point_times, lidars);
  RequireOneForEach("input.time_field", options.time_field, lidars);
  RequireOneForEach("input.time_unit", options.time_unit, lidars);
  RequireOneForEach("input.time_origin", options.time_origin, lidars);
  RequireOneForEach("input.stamp_at", options.stamp_at, lidars);
  RequireOneForEach("input.clock_offset_s", options.clock_offset_s, lidars);
  const bool has_messages = std::any_of(inputs.begin(), inputs.end(), HoldsClouds);
  if (options.scan_period_s != RecordingOptions().scan_period_s && has_messages) {
    throw UsageError(
        "input.scan_period_s is for folders of scans without stamps; a recording with messages has "
        "the stamps of these");
  }
  if (options.velodyne_model && std::none_of(inputs.begin(), inputs.end(), HoldsPackets)) {
    throw UsageError("input.velodyne_model is for captures of packets (.pcap), and none is read");
  }
  if (!options.stamps_file.empty() && has_messages) {
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
  RequireDifferentTopics(config.input);
  const std::vector<std::string> lidars = LidarNames(inputs, config.input);
  const std::size_t given = config.odometry.segmenter.T_body_lidar.size();
  if (given > lidars.size()) FailTooMany(lidars, given);
  if (lidars.size() < 2 || given == lidars.size()) return;
  if (given == 0 && ArePartsOfOne(inputs)) {
    throw UsageError(std::to_string(inputs.size()) +
                     " bags are read as one LiDAR each. If they are parts of one recording, give "
                     "the folder that holds them and nothing else; LiDARs of their own need "
                     "sensor.T_body_lidar, the pose of each in the body frame");
  }
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
