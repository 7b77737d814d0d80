// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/messages/raw_message.h"

namespace trajlo {

/// What the folder of a rosbag2 recording holds.
struct Rosbag2Folder {
  /// In the order of recording; .db3 or .mcap, perhaps with .zstd behind it.
  std::vector<std::filesystem::path> files;
  /// From metadata.yaml; empty where it is missing or broken.
  std::vector<Topic> topics;
  /// Empty, or what is wrong with metadata.yaml.
  std::string problem;
};

/// True for .db3 and .mcap and the two followed by .zstd.
bool IsRosbag2File(const std::filesystem::path& path);

/// Reads metadata.yaml. A recorder that was killed leaves none: then every bag file of the folder
/// counts, in the order of the numbers in their names. Throws InputError if there is no such file.
Rosbag2Folder ReadRosbag2Folder(const std::filesystem::path& folder);

}  // namespace trajlo
