// SPDX-License-Identifier: MIT
#include "core/io/ros2/rosbag2_metadata.h"

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <utility>

#include "core/io/errors.h"
#include "core/io/ros2/topic_names.h"
#include "core/io/scan_listing.h"

namespace trajlo {
namespace {

bool IsFile(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

/// metadata.yaml may name a file with its folder (the oldest versions do), and with or without the
/// .zstd of files that were compressed after it was written.
std::filesystem::path FindFile(const std::filesystem::path& folder,
                               const std::filesystem::path& name) {
  for (const auto& path : {folder / name, folder / name.filename()}) {
    if (IsFile(path)) return path;
    if (IsFile(path.string() + ".zstd")) return path.string() + ".zstd";
    if (path.extension() == ".zstd" && IsFile(path.parent_path() / path.stem())) {
      return path.parent_path() / path.stem();
    }
  }
  return folder / name;
}

void ReadMetadata(const std::filesystem::path& folder, Rosbag2Folder* found) {
  const YAML::Node root =
      YAML::LoadFile((folder / "metadata.yaml").string())["rosbag2_bagfile_information"];
  for (const YAML::Node& name : root["relative_file_paths"]) {
    found->files.push_back(FindFile(folder, name.as<std::string>()));
  }
  for (const YAML::Node& entry : root["topics_with_message_count"]) {
    const YAML::Node about = entry["topic_metadata"];
    Topic topic = MakeTopic(about["name"].as<std::string>(), about["type"].as<std::string>(),
                            about["serialization_format"].as<std::string>());
    topic.messages = entry["message_count"].as<std::uint64_t>();
    found->topics.push_back(std::move(topic));
  }
}

std::vector<std::filesystem::path> ListBagFiles(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (IsFile(entry.path()) && IsRosbag2File(entry.path())) files.push_back(entry.path());
  }
  SortNaturally(&files);
  return files;
}

}  // namespace

bool IsRosbag2File(const std::filesystem::path& path) {
  const std::string extension =
      path.extension() == ".zstd" ? path.stem().extension() : path.extension();
  return extension == ".db3" || extension == ".mcap";
}

Rosbag2Folder ReadRosbag2Folder(const std::filesystem::path& folder) {
  Rosbag2Folder found;
  if (!IsFile(folder / "metadata.yaml")) {
    found.problem = "there is no metadata.yaml, as after a killed recorder";
  } else {
    try {
      ReadMetadata(folder, &found);
    } catch (const YAML::Exception& error) {
      found = {};
      found.problem = std::string("metadata.yaml is broken (") + error.what() + ")";
    }
  }
  if (found.files.empty()) found.files = ListBagFiles(folder);
  if (found.files.empty()) {
    throw InputError(folder, "the folder holds no .db3 or .mcap file",
                     "Give the folder that ros2 bag record made, or one of its files.");
  }
  return found;
}

}  // namespace trajlo
