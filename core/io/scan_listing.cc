// SPDX-License-Identifier: MIT
#include "core/io/scan_listing.h"

#include <algorithm>
#include <map>
#include <set>
#include <system_error>

#include "core/io/errors.h"
#include "core/io/format_text.h"
#include "core/io/point_file.h"
#include "core/io/point_table.h"

namespace trajlo {
namespace {

namespace fs = std::filesystem;

constexpr char kMend[] =
    "Give a folder of .pcd, .ply or .bin scans, or one with them in a subfolder such as scans/ or "
    "velodyne/.";

constexpr const char* kKnownFolders[] = {"scans",
                                         "velodyne",
                                         "velodyne_points/data",
                                         "velodyne_points",
                                         "ouster",
                                         "livox",
                                         "lidar",
                                         "lidar/data",
                                         "pointclouds",
                                         "point_clouds",
                                         "pointcloud",
                                         "clouds",
                                         "frames",
                                         "pcd",
                                         "pcds",
                                         "ply",
                                         "bin",
                                         "data"};

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

/// Takes a run of digits without its leading zeros off the front.
std::string_view TakeNumber(std::string_view* text) {
  std::size_t end = 0;
  while (end < text->size() && IsDigit((*text)[end])) ++end;
  std::string_view number = text->substr(0, end);
  text->remove_prefix(end);
  number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
  return number;
}

struct FolderContent {
  std::map<std::string, std::vector<fs::path>> scans_by_extension;
  std::vector<fs::path> subfolders;
  std::size_t other_files = 0;

  std::size_t ScanCount() const {
    std::size_t count = 0;
    for (const auto& [extension, files] : scans_by_extension) count += files.size();
    return count;
  }
};

/// A link to a scan that is not there. It is listed, so that the scan is missed when it is read.
bool IsDanglingLink(const fs::directory_entry& entry) {
  std::error_code ignored;
  return entry.is_symlink(ignored) && !entry.exists(ignored);
}

FolderContent Look(const fs::path& folder) {
  FolderContent content;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    const fs::path& path = it->path();
    std::error_code ignored;
    if (path.filename().string().front() == '.') continue;
    if (it->is_directory(ignored)) {
      content.subfolders.push_back(path);
    } else if (IsPointFile(path) && (it->is_regular_file(ignored) || IsDanglingLink(*it))) {
      content.scans_by_extension[NormalisedFieldName(path.extension().string())].push_back(path);
    } else {
      ++content.other_files;
    }
  }
  if (error) throw InputError(folder, "cannot be listed: " + error.message(), kMend);
  std::sort(content.subfolders.begin(), content.subfolders.end());
  return content;
}

/// A map beside the scans has no number in its name; the scans once more have the same names.
void NoteOtherEndings(const FolderContent& content, ScanListing* listing) {
  std::set<std::string> known;
  for (const fs::path& file : listing->files) known.insert(file.stem().string());
  std::string first;
  for (const auto& [extension, files] : content.scans_by_extension) {
    if (extension == listing->extension) continue;
    for (const fs::path& file : files) {
      const std::string name = file.stem().string();
      const bool has_number = std::any_of(name.begin(), name.end(), IsDigit);
      if (!has_number || known.count(name) > 0) continue;
      const std::string whole = file.filename().string();
      if (listing->left_out++ == 0 || NaturalLess(whole, first)) first = whole;
    }
  }
  const std::size_t others = content.ScanCount() - listing->files.size();
  if (others == 0) return;
  std::string sentence = "left out: " + CountOf(others, "point file") + " in " +
                         listing->folder.string() + " that " + (others == 1 ? "does" : "do") +
                         " not end in " + listing->extension;
  if (listing->left_out > 0) {
    sentence +=
        "; " + CountOf(listing->left_out, "is a scan", "are scans") +
        " that no other file has, the first " + first +
        ". Scans must be of one format: convert them, or put them into folders of their own";
  }
  listing->warnings.push_back(sentence);
}

ScanListing MakeListing(const fs::path& folder, const FolderContent& content) {
  ScanListing listing;
  listing.folder = folder;
  for (const auto& [extension, files] : content.scans_by_extension) {
    if (files.size() > listing.files.size()) {
      listing.files = files;
      listing.extension = extension;
    }
  }
  NoteOtherEndings(content, &listing);
  SortNaturally(&listing.files);
  return listing;
}

[[noreturn]] void FailSeveral(const fs::path& path, const std::vector<fs::path>& folders) {
  std::string names;
  for (const fs::path& folder : folders) names += " " + folder.lexically_relative(path).string();
  throw InputError(path, "several subfolders hold scans:" + names, "Give one of them.");
}

}  // namespace

bool NaturalLess(std::string_view a, std::string_view b) {
  const std::string_view whole_a = a;
  const std::string_view whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (IsDigit(a.front()) && IsDigit(b.front())) {
      const std::string_view number_a = TakeNumber(&a);
      const std::string_view number_b = TakeNumber(&b);
      if (number_a.size() != number_b.size()) return number_a.size() < number_b.size();
      if (number_a != number_b) return number_a < number_b;
      continue;
    }
    if (a.front() != b.front()) return a.front() < b.front();
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  if (a.empty() && b.empty()) return whole_a < whole_b;  // "7" and "007": any fixed order will do.
  return a.empty();
}

void SortNaturally(std::vector<fs::path>* files) {
  std::sort(files->begin(), files->end(), [](const fs::path& a, const fs::path& b) {
    return NaturalLess(a.filename().string(), b.filename().string());
  });
}

ScanListing ListScans(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) {
    if (error) throw InputError(path, "cannot be opened: " + error.message(), "");
    throw InputError(path, "there is no such file or folder", "Check the path.");
  }
  if (!fs::is_directory(path, error)) throw InputError(path, "this is not a folder", kMend);

  std::vector<fs::path> known;
  for (const char* name : kKnownFolders) {
    const fs::path folder = path / name;
    if (fs::is_directory(folder, error) && Look(folder).ScanCount() > 0) known.push_back(folder);
  }
  if (known.size() > 1) FailSeveral(path, known);
  FolderContent content = Look(path);
  if (known.size() == 1) {
    ScanListing listing = MakeListing(known.front(), Look(known.front()));
    if (content.ScanCount() > 0) {
      listing.notes.push_back("left out: " + CountOf(content.ScanCount(), "point file") + " in " +
                              path.string() + " itself");
    }
    return listing;
  }
  // A result holds point clouds, too; with the scans in a folder of their own it is no obstacle.
  if (fs::exists(path / "run.json", error) && fs::exists(path / "trajectory.tum", error)) {
    throw InputError(path, "this is a result of trajlo_run, not a recording",
                     "trajlo_convert turns it into other formats.");
  }
  if (content.ScanCount() > 0) return MakeListing(path, std::move(content));

  std::vector<fs::path> others;
  for (const fs::path& folder : content.subfolders) {
    if (Look(folder).ScanCount() > 0) others.push_back(folder);
  }
  if (others.size() > 1) FailSeveral(path, others);
  if (others.size() == 1) return MakeListing(others.front(), Look(others.front()));
  throw InputError(path,
                   "no scans: " + CountOf(content.subfolders.size(), "subfolder") + " and " +
                       CountOf(content.other_files, "file of another kind", "files of other kinds"),
                   kMend);
}

}  // namespace trajlo
