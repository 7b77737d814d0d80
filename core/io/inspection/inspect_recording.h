// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/io/inspection/inspection.h"
#include "core/io/messages/cloud_message.h"
#include "core/io/recording/open_clouds.h"

namespace trajlo {

struct InspectionOptions {
  CloudOptions clouds;
  /// Stop after this many messages of each LiDAR; 0 reads everything.
  std::size_t messages_per_lidar = 0;
  /// Told the messages read so far and those that are listed.
  std::function<void(std::size_t, std::size_t)> on_progress;
  /// Asked now and then; true ends the reading early.
  std::function<bool()> should_stop;
};

/// Looks at a recording: a bag, a capture, a folder of bags or of scans, or a folder with lidar0,
/// lidar1, ... in it. Times are understood as OpenRecording does with default options, but where
/// it refuses, the inspection goes on without times and says why. Throws InputError when nothing
/// can be read.
RecordingInspection InspectRecording(const std::string& path, const InspectionOptions& options);

/// The same for clouds from elsewhere. `open` is called twice: for the evidence, and to look.
RecordingInspection InspectClouds(const std::filesystem::path& path,
                                  const std::function<std::unique_ptr<CloudMessageReader>()>& open,
                                  const InspectionOptions& options);

}  // namespace trajlo
