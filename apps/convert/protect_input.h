// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/recording/recording_options.h"

namespace trajlo {

/// The files and folders that reading the inputs of a recording (see InputPaths) opens, as far as
/// they are there.
std::vector<std::filesystem::path> FilesOfRecording(const std::vector<std::string>& inputs,
                                                    const RecordingOptions& options);

/// Throws UsageError if writing `output` would remove or replace something that is `read`. Changes
/// nothing.
void ProtectInput(const std::vector<std::filesystem::path>& read,
                  const std::filesystem::path& output);

}  // namespace trajlo
