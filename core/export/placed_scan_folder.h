// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/export/result_bag.h"
#include "core/export/scan_placer.h"
#include "core/io/trajectory_writer.h"

namespace trajlo {

/// Writes the deskewed scans of one LiDAR as scans/000000.pcd (or .ply), ..., and beside them the
/// pose of the body at the stamp of each: poses.txt in KITTI's format, poses.tum, and
/// timestamps.txt, a line a scan. In the body's frame, scans are motion-corrected as KITTI's are.
/// Members throw OutputError.
class PlacedScanFolder {
 public:
  /// `extension` is ".pcd" or ".ply".
  PlacedScanFolder(const std::filesystem::path& folder, std::string extension, PointFrame frame);

  void Write(const PlacedScan& scan);
  void Close();

 private:
  std::filesystem::path folder_;
  std::string extension_;
  PointFrame frame_;
  std::optional<KittiWriter> kitti_;
  std::optional<TumWriter> tum_;
  std::string stamps_;
  std::size_t scans_ = 0;
};

}  // namespace trajlo
