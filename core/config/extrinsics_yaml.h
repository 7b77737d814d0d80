// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "manifolds/se3.h"

namespace YAML {
class Node;
}

namespace trajlo {

/// Reads a list of transforms: {translation_m: [x, y, z], rotation: [qx, qy, qz, qw]} or
/// {matrix: 3 or 4 rows of 4}; what is left out is zero or the identity. Throws ValueError.
std::vector<SE3> ParseExtrinsics(const YAML::Node& node);

/// "{translation_m: [0.0, 0.0, 0.0], rotation: [0.0, 0.0, 0.0, 1.0]}"
std::string ExtrinsicText(const SE3& T);

}  // namespace trajlo
