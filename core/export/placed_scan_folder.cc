// SPDX-License-Identifier: MIT
#include "core/export/placed_scan_folder.h"

#include <utility>

#include "core/io/atomic_file.h"
#include "core/io/errors.h"
#include "core/io/format_text.h"
#include "core/io/point_cloud_writer.h"
#include "core/io/stamp_text.h"

namespace trajlo {

PlacedScanFolder::PlacedScanFolder(const std::filesystem::path& folder, std::string extension,
                                   PointFrame frame)
    : folder_(folder), extension_(std::move(extension)), frame_(frame) {
  std::error_code error;
  std::filesystem::create_directories(folder_ / "scans", error);
  if (error) throw OutputError(folder_, "cannot make the folder: " + error.message());
  // Scans of an earlier result are gone by now, and these belong to them.
  kitti_.emplace(folder_ / "poses.txt", IfExists::kReplace);
  tum_.emplace(folder_ / "poses.tum", IfExists::kReplace);
}

void PlacedScanFolder::Write(const PlacedScan& scan) {
  const SE3 T_frame_world = FrameFromWorld(frame_, scan.T_world_body);
  std::vector<CloudPoint> points;
  points.reserve(scan.points_world_m.size());
  for (std::size_t i = 0; i < scan.points_world_m.size(); ++i) {
    points.push_back({(T_frame_world * scan.points_world_m[i]).cast<float>(), scan.intensities[i]});
  }
  WritePointCloud(folder_ / "scans" / (FormatText("%06zu", scans_++) + extension_), points);
  kitti_->Append(scan.T_world_body);
  tum_->Append(scan.t_ns, scan.T_world_body);
  stamps_ += FormatSeconds(scan.t_ns) + "\n";
}

void PlacedScanFolder::Close() {
  kitti_->Close();
  tum_->Close();
  WriteTextFile(folder_ / "timestamps.txt", stamps_);
}

}  // namespace trajlo
