// SPDX-License-Identifier: MIT
#include "core/io/conversion/pcd_folder_writer.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "core/io/atomic_file.h"
#include "core/io/errors.h"
#include "core/io/format_text.h"
#include "core/io/point_cloud_writer.h"
#include "core/io/stamp_text.h"

namespace trajlo {
namespace {

namespace fs = std::filesystem;

std::uint32_t OffsetNs(const fs::path& path, std::int64_t offset_ns) {
  if (offset_ns < 0 || offset_ns > std::numeric_limits<std::uint32_t>::max()) {
    throw OutputError(path, "a point " + std::to_string(offset_ns) +
                                " ns after the start of its sweep does not fit into the file");
  }
  return static_cast<std::uint32_t>(offset_ns);
}

}  // namespace

std::vector<fs::path> ScanPaths(const fs::path& folder) {
  std::vector<fs::path> paths = {folder / "scans", folder / "timestamps.txt",
                                 folder / "record_times.txt"};
  for (int id = 0;; ++id) {
    const fs::path lidar = folder / ("lidar" + std::to_string(id));
    std::error_code error;
    if (!fs::exists(fs::symlink_status(lidar, error))) return paths;
    paths.push_back(lidar);
  }
}

void RemoveScans(const fs::path& folder) {
  std::error_code error;
  for (const fs::path& path : ScanPaths(folder)) fs::remove_all(path, error);
}

void PrepareScanFolder(const fs::path& folder, IfExists if_exists) {
  std::error_code error;
  if (!fs::exists(folder, error) || fs::is_empty(folder, error)) return;
  if (!fs::is_directory(folder, error) || if_exists == IfExists::kFail) {
    throw OutputError(folder, "is there already; choose another folder or add --overwrite");
  }
  RemoveScans(folder);
}

std::int64_t SweepStartOf(const LidarScan& scan) {
  if (!scan.has_point_times || scan.points.empty()) return scan.stamp_ns;
  const auto [first, last] =
      std::minmax_element(scan.points.begin(), scan.points.end(),
                          [](const LidarPoint& a, const LidarPoint& b) { return a.t_ns < b.t_ns; });
  const bool stamp_is_start = scan.stamp_ns <= first->t_ns &&
                              first->t_ns - scan.stamp_ns <= (last->t_ns - first->t_ns) / 20;
  return stamp_is_start ? scan.stamp_ns : first->t_ns;
}

std::int64_t SweepEndOf(const LidarScan& scan) {
  std::int64_t end_ns = scan.stamp_ns;
  for (const LidarPoint& point : scan.points) end_ns = std::max(end_ns, point.t_ns);
  return end_ns;
}

PcdFolderWriter::PcdFolderWriter(fs::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  fs::create_directories(folder_ / "scans", error);
  if (error) throw OutputError(folder_, "cannot make the folder: " + error.message());
}

void PcdFolderWriter::Write(const LidarScan& scan, std::optional<std::int64_t> recorded_ns) {
  const fs::path path = folder_ / "scans" / FormatText("%06zu.pcd", stamps_ns_.size());
  const std::int64_t start_ns = SweepStartOf(scan);
  stamps_ns_.push_back(start_ns);
  if (recorded_ns) recorded_ns_.push_back(*recorded_ns);
  std::string bytes = scan.has_point_times
                          ? PcdHeader("x y z intensity t", "FFFFU", scan.points.size())
                          : PcdHeader("x y z intensity", "FFFF", scan.points.size());
  const std::size_t begin = bytes.size();
  const std::size_t step = scan.has_point_times ? 20 : 16;
  bytes.resize(begin + step * scan.points.size());
  char* at = bytes.data() + begin;
  for (const LidarPoint& point : scan.points) {
    std::memcpy(at, point.xyz_m.data(), 12);
    std::memcpy(at + 12, &point.intensity, 4);
    if (scan.has_point_times) {
      const std::uint32_t offset_ns = OffsetNs(path, point.t_ns - start_ns);
      std::memcpy(at + 16, &offset_ns, 4);
    }
    at += step;
  }
  OutputFile file(path, IfExists::kFail);
  file.Write(bytes);
  file.Close();
}

void PcdFolderWriter::Close() {
  WriteTextFile(folder_ / "timestamps.txt", FormatStampsFile(stamps_ns_));
  if (recorded_ns_.empty()) return;
  WriteTextFile(folder_ / "record_times.txt", FormatStampsFile(recorded_ns_));
}

}  // namespace trajlo
