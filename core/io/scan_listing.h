// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace trajlo {

/// The scan files of a recording.
struct ScanListing {
  std::filesystem::path folder;
  /// ".pcd", ".ply" or ".bin"
  std::string extension;
  /// In natural order: scan9 comes before scan10.
  std::vector<std::filesystem::path> files;
  /// What was left out that does not matter, and why, to be printed.
  std::vector<std::string> notes;
  /// Point files that end otherwise and are left out.
  std::vector<std::string> warnings;
  /// How many of these are scans that are not in `files` in another form.
  std::size_t left_out = 0;
};

/// Finds the scans of the recording `path`: in a subfolder with a well-known name (scans,
/// velodyne, velodyne_points/data, ...), else in `path` itself, else in the only subfolder that
/// holds scans. The most frequent extension wins; of the others, a name with a number that no file
/// of the listing has is that of a scan that is left out. Throws InputError when there are none, or
/// when two subfolders are equally good.
ScanListing ListScans(const std::filesystem::path& path);

/// True if `a` comes before `b` when runs of digits are compared as numbers.
bool NaturalLess(std::string_view a, std::string_view b);
/// By the names of the files, whatever their folders.
void SortNaturally(std::vector<std::filesystem::path>* files);

}  // namespace trajlo
