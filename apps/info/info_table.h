// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/io/inspection/inspection.h"

namespace trajlo {

/// For people: topics, then each LiDAR, then how to run.
std::string InfoTable(const RecordingInspection& recording);

}  // namespace trajlo
