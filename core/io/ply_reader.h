// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "core/io/point_table.h"

namespace trajlo {

/// Takes a PLY file (ascii, binary of either byte order, any properties) apart into the columns
/// of its vertex element. List properties and elements before the vertices are skipped.
/// `path` is for messages only. A truncated file gives the points that are there and says so in
/// `damage`; a broken header throws InputError.
/// Debian 12 has no PLY library (tinyply, happly and rply are not packaged), hence these lines.
PointTable ReadPly(const std::filesystem::path& path, FileBytes bytes);

}  // namespace trajlo
