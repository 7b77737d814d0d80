// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/trajectory_reader.h"

namespace trajlo {

/// Parses EuRoC's csv of poses: "t_ns,x,y,z,qw,qx,qy,qz", further columns are ignored. A first
/// line that does not begin with a number, and comments above the rows, are a heading, which must
/// not have w last. Lines with a number that is not finite or a zero quaternion are skipped with a
/// warning; everything else that is not such a row throws InputError with the line's number, and so
/// do stamps that are too close together for ns. `path` is used in messages only.
std::vector<StampedPose> ParseEurocCsv(const std::filesystem::path& path, std::string_view text,
                                       std::vector<std::string>* warnings);

}  // namespace trajlo
