// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "core/report/scan_sampler.h"

namespace trajlo {

/// Writes points as a binary PLY of float32 with x, y, z (m, world), intensity, and t_s: when the
/// point's moment began, in seconds after the first one, whose time is in the header as
/// "comment begin_s 1317042000.103499889".
/// An earlier file is replaced. Throws OutputError.
void WriteViewPly(const std::filesystem::path& path, const std::vector<WorldPoint>& points);

}  // namespace trajlo
