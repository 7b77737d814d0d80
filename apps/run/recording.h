// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/io/scan_folder.h"
#include "core/io/scan_source.h"

namespace trajlo {

/// The folders that `--input` names, one per LiDAR: separated by commas, or the subfolders lidar0,
/// lidar1, ... of the one folder that it names.
std::vector<std::string> InputFolders(const std::string& input);

/// Opens a recording of one or several LiDARs; scans come in the order of their stamps, and
/// `lidar_id` is the place in `folders`. Throws InputError.
std::unique_ptr<ScanSource> OpenRecording(const std::vector<std::string>& folders,
                                          const ScanFolderOptions& options);

}  // namespace trajlo
