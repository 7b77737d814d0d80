// SPDX-License-Identifier: MIT
#include "core/io/recording/open_recording.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <utility>

#include "core/io/errors.h"
#include "core/io/recording/cloud_recording.h"
#include "core/io/recording/excerpt.h"
#include "core/io/recording/merged_recording.h"
#include "core/io/recording/open_clouds.h"
#include "core/io/scan_folder.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

namespace fs = std::filesystem;

std::unique_ptr<ScanSource> OpenFolder(const std::string& input, const RecordingOptions& options,
                                       std::size_t lidar_id, bool read_ahead,
                                       const std::string& remark) {
  ScanFolderOptions own;
  own.read_ahead = read_ahead;
  own.lidar_id = static_cast<int>(lidar_id);
  own.time = options.TimeOf(lidar_id);
  own.stamps_file = options.stamps_file;
  own.clock_offset_ns = Nanoseconds(options.clock_offset_s.Of(lidar_id));
  own.scan_period_s = options.scan_period_s;
  own.remark = remark;
  return std::make_unique<ScanFolder>(input, own);
}

std::string FolderName(const fs::path& path) {
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

bool IsNameOf(const std::string& topic, const std::string& input) {
  return topic == input || topic == FolderName(input);
}

/// What is to be said of topics that go with `inputs`, of which none has any. A configuration for
/// the bag that folders come from has them, so this is no error.
std::string RemarkAbout(const std::vector<std::string>& topics,
                        const std::vector<std::string>& inputs) {
  if (topics.empty() || std::any_of(inputs.begin(), inputs.end(), HoldsClouds)) return "";
  if (IsNameOf(topics.front(), inputs.front())) return "";
  std::string list;
  for (const std::string& topic : topics) list += (list.empty() ? "" : ", ") + topic;
  return "input.topics (" + list + ") is not used, as folders of scans have no topics";
}

}  // namespace

std::vector<std::string> InputPaths(const std::string& input) {
  std::error_code error;
  std::vector<std::string> paths;
  if (fs::exists(input, error)) {  // A name may hold a comma.
    for (int id = 0;; ++id) {
      const fs::path folder = fs::path(input) / ("lidar" + std::to_string(id));
      if (!fs::is_directory(folder, error)) break;
      paths.push_back(folder.string());
    }
    return paths.empty() ? std::vector<std::string>{input} : paths;
  }
  std::istringstream parts(input);
  for (std::string part; std::getline(parts, part, ',');) {
    if (!part.empty()) paths.push_back(part);
  }
  return paths;
}

std::vector<std::string> ChosenInputs(const std::vector<std::string>& inputs,
                                      const RecordingOptions& options) {
  const bool has_topics = std::any_of(inputs.begin(), inputs.end(), HoldsClouds);
  if (options.topics.empty() || inputs.empty() || has_topics) return inputs;
  std::vector<std::string> chosen;
  for (const std::string& topic : options.topics) {
    const auto folder = std::find_if(inputs.begin(), inputs.end(), [&](const std::string& input) {
      return IsNameOf(topic, input);
    });
    if (folder != inputs.end()) chosen.push_back(*folder);
  }
  if (chosen.size() == options.topics.size()) return chosen;
  if (chosen.empty() && inputs.size() == options.topics.size()) return inputs;
  std::string folders;
  for (const std::string& input : inputs) folders += "\n    " + FolderName(input);
  const fs::path first = inputs.front();
  throw InputError(inputs.size() > 1 && first.has_parent_path() ? first.parent_path() : first,
                   "folders of scans have no topics; input.topics can name these:" + folders,
                   "Leave input.topics empty to read all.");
}

std::vector<std::string> LidarNames(const std::vector<std::string>& inputs,
                                    const RecordingOptions& options) {
  std::vector<std::string> names;
  for (const std::string& input : ChosenInputs(inputs, options)) {
    if (options.topics.empty() || !HoldsClouds(input)) {
      names.push_back(input);
      continue;
    }
    for (const std::string& topic : options.topics) names.push_back(topic + " of " + input);
  }
  return names;
}

std::unique_ptr<ScanSource> OpenRecording(const std::vector<std::string>& inputs,
                                          const RecordingOptions& options, int threads) {
  CloudOptions clouds;
  clouds.packets.velodyne_model = options.velodyne_model;
  clouds.threads = threads;
  const bool read_ahead = threads != 1;
  std::vector<std::unique_ptr<ScanSource>> sources;
  std::size_t lidar_id = 0;
  const std::vector<std::string> chosen = ChosenInputs(inputs, options);
  for (const std::string& input : chosen) {
    if (!HoldsClouds(input)) {
      const std::string remark = lidar_id == 0 ? RemarkAbout(options.topics, chosen) : "";
      sources.push_back(OpenFolder(input, options, lidar_id++, read_ahead, remark));
      continue;
    }
    auto recording = std::make_unique<CloudRecording>(
        input, [&] { return OpenClouds(input, clouds); }, options, lidar_id, read_ahead);
    lidar_id += recording->lidars();
    sources.push_back(std::move(recording));
  }
  std::unique_ptr<ScanSource> whole;
  if (sources.size() == 1) {
    whole = std::move(sources.front());
  } else {
    whole = std::make_unique<MergedRecording>(std::move(sources));
  }
  if (options.start_s == 0.0 && options.duration_s == 0.0) return whole;
  return std::make_unique<Excerpt>(std::move(whole), Nanoseconds(options.start_s),
                                   Nanoseconds(options.duration_s));
}

}  // namespace trajlo
