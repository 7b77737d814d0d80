// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/export/coloring.h"
#include "core/io/output_file.h"

namespace trajlo {

/// Writes a map in binary, as PLY (x y z nx ny nz intensity curvature red green blue) or as PCD as
/// PCL names things (x y z intensity normal_x normal_y normal_z curvature rgb), by the extension of
/// `path`. One colour for each surfel. The file appears under its name only when it is complete.
/// Throws OutputError; also for another extension.
void WriteMapFile(const std::filesystem::path& path, const std::vector<Surfel>& surfels,
                  const std::vector<Rgb>& colors, IfExists if_exists = IfExists::kFail);

/// The names and values of a map without its colours, as WriteFloatCloud() takes them.
std::vector<std::string> MapFields();
std::vector<float> MapValues(const std::vector<Surfel>& surfels);

}  // namespace trajlo
