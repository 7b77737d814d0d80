// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "core/io/point_table.h"

namespace trajlo {

/// Takes a PCD file (ascii, binary, binary_compressed; any fields, padding `_` included) apart.
/// `path` is for messages only. A truncated ascii or binary file gives the points that are there
/// and says so in `damage`; a broken header and a broken compressed block throw InputError
/// (in a compressed block all x come first and all z later, so a part of it holds no point).
/// PCL's own reader was weighed: it pulls in VTK, more than 1 GB, for what liblzf and these lines
/// do.
PointTable ReadPcd(const std::filesystem::path& path, FileBytes bytes);

}  // namespace trajlo
