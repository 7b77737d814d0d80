// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/io/inspection/inspection.h"

namespace trajlo {

/// For people: topics, then each LiDAR, then how to run, by the programs of `program_folder` ("" or
/// with a slash at its end).
std::string InfoTable(const RecordingInspection& recording, const std::string& program_folder);

}  // namespace trajlo
