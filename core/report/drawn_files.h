// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

namespace trajlo {

/// The files of an evaluation in `folder`, its summary first: those that every evaluation has, and
/// the errors_<name>.csv that the one which is there says it wrote.
std::vector<std::filesystem::path> EvaluationFiles(const std::filesystem::path& folder);

/// Removes what trajlo's other commands and scripts have written into the folder of a result about
/// it: the page and its figures, an evaluation, and the factor graphs of windows. Leaves all other
/// files, folders that hold any, and links. Throws OutputError.
void RemoveWhatIsAboutResult(const std::filesystem::path& folder);

/// Removes an earlier comparison from its folder: what trajlo_compare_solvers and
/// draw_comparison.py have written, and nothing else. Throws OutputError.
void RemoveComparison(const std::filesystem::path& folder);

}  // namespace trajlo
