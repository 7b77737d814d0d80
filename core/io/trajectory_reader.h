// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "manifolds/se3.h"

namespace trajlo {

/// The pose of the body in the world at a time.
struct StampedPose {
  std::int64_t t_ns = 0;
  SE3 T_world_body;
  /// False: a position alone, for whose rotation the identity stands.
  bool has_rotation = true;
};

/// Reads a trajectory in TUM's format, poses in the order of the file, quaternions normalised.
/// Blank lines and lines that begin with # are skipped; columns are separated by blanks or tabs.
/// Skipped with a warning: lines with a number that is not finite or a quaternion that is zero,
/// and an incomplete last line without a line end (an interrupted recording). Where every
/// quaternion is zero, or the first line is `stamp x y z`, as in the truth of a total station, the
/// poses have the identity for a rotation. Everything else that is not eight (four) numbers throws
/// InputError with the line's number.
std::vector<StampedPose> ReadTum(const std::filesystem::path& path,
                                 std::vector<std::string>* warnings = nullptr);

/// The same for text that is in memory; `path` is used in messages only.
std::vector<StampedPose> ParseTum(const std::filesystem::path& path, std::string_view text,
                                  std::vector<std::string>* warnings = nullptr);

}  // namespace trajlo
