// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/io/recording/recording_options.h"
#include "core/io/scan_source.h"

namespace trajlo {

/// The files and folders that `--input` names: separated by commas, or the subfolders lidar0,
/// lidar1, ... of the one folder that it names.
std::vector<std::string> InputPaths(const std::string& input);

/// The inputs that `options.topics` means where none of them has topics: the folders whose own
/// names these are, in that order. As many topics as folders that name none of them are those of a
/// bag whose LiDARs the folders hold; OpenRecording() warns then. Throws InputError if neither is
/// so.
std::vector<std::string> ChosenInputs(const std::vector<std::string>& inputs,
                                      const RecordingOptions& options);

/// What each LiDAR of the inputs is called, in the order of their ids: its topic with the file, or
/// its folder. Opens nothing, and so does not know the topic where `options` name none.
std::vector<std::string> LidarNames(const std::vector<std::string>& inputs,
                                    const RecordingOptions& options);

/// Opens a recording of one or several LiDARs. Each input is
///   - a folder of scans: one LiDAR,
///   - a bag (.bag, .db3, .mcap), a capture of packets (.pcap), or a folder of bags that follow
///     each other: as many LiDARs as `options.topics` names.
/// `lidar_id` counts through the inputs. Several inputs are merged (see MergedRecording).
/// `threads` as in CloudOptions; with 1, nothing is read ahead. The scans do not depend on it.
/// Throws InputError.
std::unique_ptr<ScanSource> OpenRecording(const std::vector<std::string>& inputs,
                                          const RecordingOptions& options, int threads = 1);

}  // namespace trajlo
