// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/graph/window_graph.h"

namespace trajlo {

/// "000431": the name of the files of a window, without the ending.
std::string GraphName(std::int64_t index);

/// Writes the factor graph of the window with this index of windows.csv to `folder`, which is made:
/// NAME.json has poses, weights, motion terms, prior, H, g and costs; NAME.ply has the points as
/// they enter the registration, float64. Earlier files are replaced. Throws OutputError.
void WriteGraphFiles(const std::filesystem::path& folder, std::int64_t index, const Window& window);

}  // namespace trajlo
