// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/io/output_file.h"
#include "core/scans/lidar_scan.h"

namespace trajlo {

/// Writes the scans of one LiDAR as scans/000000.pcd, ... and timestamps.txt with a stamp a line.
/// The files are binary with fields x y z intensity (float32) and, if points have times, t (uint32,
/// ns since the scan's stamp, which is moved to the start of the sweep): exact, where seconds as
/// float32 are good to 4 ns only. Where times of recording are given, record_times.txt has them, so
/// that the scans of several LiDARs keep their order. Members throw OutputError.
class PcdFolderWriter {
 public:
  explicit PcdFolderWriter(std::filesystem::path folder);

  /// `recorded_ns` for all scans or for none.
  void Write(const LidarScan& scan, std::optional<std::int64_t> recorded_ns = {});
  /// Writes the stamps.
  void Close();

 private:
  std::filesystem::path folder_;
  std::vector<std::int64_t> stamps_ns_, recorded_ns_;
};

/// Where PcdFolderWriters leave something in a folder: its scans and their times, and its
/// subfolders lidar0, lidar1, ... as far as they are there.
std::vector<std::filesystem::path> ScanPaths(const std::filesystem::path& folder);

/// Removes the ScanPaths() of a folder.
void RemoveScans(const std::filesystem::path& folder);

/// Makes sure that nothing is lost, and that no scan of an older recording stays behind: a folder
/// that is not empty throws OutputError, or loses its scans if they may be replaced.
void PrepareScanFolder(const std::filesystem::path& folder, IfExists if_exists);

/// What the times of a scan's points count from when it is written: the stamp where that marks the
/// start of the sweep, else the first point.
std::int64_t SweepStartOf(const LidarScan& scan);
/// The time of the last point, at least the scan's stamp.
std::int64_t SweepEndOf(const LidarScan& scan);

}  // namespace trajlo
