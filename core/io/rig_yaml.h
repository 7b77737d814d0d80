// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "manifolds/se3.h"

namespace trajlo {

/// A configuration with sensor.T_body_lidar and, unless there are none, input.clock_offset_s, for
/// --config; `comment` becomes its first line.
std::string RigYaml(const std::string& comment, const std::vector<SE3>& T_body_lidar,
                    const std::vector<double>& clock_offsets_s = {});

}  // namespace trajlo
