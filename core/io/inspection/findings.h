// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/io/inspection/inspection.h"

namespace trajlo {

/// What a user should know before running on a LiDAR, a sentence each, with numbers: no decision on
/// the point times, sweeps that overlap, gaps, stamps that repeat or step back, ...
std::vector<std::string> FindingsOf(const CloudInspection& cloud);

}  // namespace trajlo
