// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/io/inspection/inspection.h"

namespace trajlo {

/// For programs: {"recordings": [...]}. Times are whole nanoseconds in keys that end in _ns.
std::string InfoJson(const std::vector<RecordingInspection>& recordings);

}  // namespace trajlo
