// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "core/io/point_table.h"

namespace trajlo {

/// True for the extensions .pcd, .ply and .bin, in any case.
bool IsPointFile(const std::filesystem::path& path);

/// Reads a point file by its extension. `.bin` is float32 without a header: KITTI's x y z
/// intensity, or nuScenes' x y z intensity ring, told by the rings; no times. A damaged file gives
/// what can be read and says so in `damage`; a file that gives nothing throws InputError.
PointTable ReadPointFile(const std::filesystem::path& path);

}  // namespace trajlo
