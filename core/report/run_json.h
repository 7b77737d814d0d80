// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "core/report/run_summary.h"

namespace trajlo {

/// The summary as indented JSON with keys in a fixed order. Two equal runs differ only in
/// "resources" and in paths.
std::string RunJson(const RunSummary& summary);

/// Replaces the file at once, so that a reader never sees half of it. Throws OutputError.
void WriteRunJson(const std::filesystem::path& path, const RunSummary& summary);

}  // namespace trajlo
