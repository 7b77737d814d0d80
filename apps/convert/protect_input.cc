// SPDX-License-Identifier: MIT
#include "apps/convert/protect_input.h"

#include <algorithm>
#include <system_error>

#include "apps/usage_error.h"
#include "core/io/conversion/open_bag.h"
#include "core/io/conversion/pcd_folder_writer.h"
#include "core/io/errors.h"
#include "core/io/recording/open_clouds.h"
#include "core/io/scan_listing.h"

namespace trajlo {
namespace {

namespace fs = std::filesystem;

/// Without links and dots, so that paths can be compared; what is not there keeps its name.
fs::path Real(const fs::path& path) {
  std::error_code error;
  const fs::path absolute = fs::absolute(path, error);
  const fs::path real = fs::weakly_canonical(absolute, error);
  const fs::path& known = error ? absolute : real;
  return known.has_filename() ? known : known.parent_path();
}

bool IsWithin(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

/// Other files may lie there as well, and be replaced.
void AddBagsIn(const fs::path& folder, std::vector<fs::path>* files) {
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (IsBagName(it->path()) || it->path().filename() == "metadata.yaml") {
      files->push_back(it->path());
    }
  }
}

void AddScanFolder(const fs::path& folder, std::vector<fs::path>* files) {
  ScanListing listing;
  try {
    listing = ListScans(folder);
  } catch (const InputError&) {
    return;  // Whoever opens it says what is wrong.
  }
  files->push_back(listing.folder);
  std::error_code error;
  for (const fs::path& file : listing.files) {
    if (fs::is_symlink(file, error)) files->push_back(file);
  }
  // Times are looked for beside the scans and one level up.
  const fs::path absolute = fs::absolute(listing.folder, error).lexically_normal();
  const fs::path beside = absolute.has_filename() ? absolute : absolute.parent_path();
  for (const char* name : {"timestamps.txt", "record_times.txt"}) {
    const bool is_beside = fs::exists(beside / name, error);
    files->push_back((is_beside ? beside : beside.parent_path()) / name);
  }
}

/// What OutputFile, AtomicFile and PrepareScanFolder remove or replace.
std::vector<fs::path> ReplacedBy(const fs::path& output) {
  std::error_code error;
  if (fs::is_directory(output, error)) return ScanPaths(output);
  return {output, output.string() + ".part"};
}

}  // namespace

std::vector<fs::path> FilesOfRecording(const std::vector<std::string>& inputs,
                                       const RecordingOptions& options) {
  std::vector<fs::path> files;
  for (const std::string& input : inputs) {
    std::error_code error;
    files.emplace_back(input);
    if (!fs::is_directory(input, error)) continue;
    if (HoldsClouds(input)) {
      AddBagsIn(input, &files);
    } else {
      AddScanFolder(input, &files);
    }
  }
  files.emplace_back(options.stamps_file);
  const auto is_missing = [](const fs::path& file) {
    std::error_code error;
    return !fs::exists(file, error);
  };
  files.erase(std::remove_if(files.begin(), files.end(), is_missing), files.end());
  return files;
}

void ProtectInput(const std::vector<fs::path>& read, const fs::path& output) {
  const fs::path own = Real(output);
  std::vector<fs::path> replaced = ReplacedBy(output);
  for (fs::path& path : replaced) path = Real(path);
  for (const fs::path& path : read) {
    const fs::path real = Real(path);
    const bool is_lost = std::any_of(replaced.begin(), replaced.end(), [&](const fs::path& folder) {
      return IsWithin(real, folder);
    });
    if (!is_lost && real != own) continue;
    throw UsageError("the output " + output.string() + " would replace " + path.string() +
                     ", which is a part of the input; choose another output");
  }
}

}  // namespace trajlo
