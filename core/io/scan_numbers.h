// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace trajlo {

/// Scans that are not there, by the numbers in the names of those that are.
struct MissingScans {
  /// For each file, how many are missing before it, all in all.
  std::vector<std::size_t> before;
  /// What was found, to be printed; empty if the numbers go on evenly or say nothing.
  std::string finding;
};

/// Of files in their order whose names have one number each, as in 000012.pcd or scan_12.pcd. Where
/// the number goes on by a multiple of its usual step, scans are missing; if by more than a minute
/// of a usual LiDAR, it has another meaning, and the finding says that no time is left out.
MissingScans FindMissingScans(const std::vector<std::filesystem::path>& files);

}  // namespace trajlo
