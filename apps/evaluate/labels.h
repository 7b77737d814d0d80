// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace trajlo {

/// Names for tables: the files' names without extension if they differ, else what differs of their
/// paths ("runs/a/trajectory.tum" and "runs/b/trajectory.tum" are a and b).
std::vector<std::string> Labels(const std::vector<std::filesystem::path>& files);

/// The same names as parts of file names: other bytes than letters, digits, '.', '-' and those of
/// UTF-8 become '_', and names that are equal then get a number.
std::vector<std::string> FileNames(const std::vector<std::string>& labels);

}  // namespace trajlo
