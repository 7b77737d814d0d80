// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "manifolds/se3.h"

namespace YAML {
class Node;
}

namespace trajlo {

/// Reads a list of transforms: {translation_m: [x, y, z], rotation: [qx, qy, qz, qw]}, in which
/// what is left out is zero or the identity; {matrix: ...}; or the matrix itself, 3 or 4 rows of 4,
/// also as a flat list of 12 or 16 numbers row by row. A single transform needs no list around it,
/// unless it is a matrix as rows. Throws ValueError.
std::vector<SE3> ParseExtrinsics(const YAML::Node& node);

/// "{translation_m: [0.0, 0.0, 0.0], rotation: [0.0, 0.0, 0.0, 1.0]}"
std::string ExtrinsicText(const SE3& T);

}  // namespace trajlo
