// SPDX-License-Identifier: MIT
#include "core/export/scan_placer.h"

#include <algorithm>
#include <cmath>

#include "core/odometry/segments/turn_up.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {

ScanPlacer::ScanPlacer(const Trajectory* trajectory, const SegmenterOptions& segmenter)
    : trajectory_(trajectory),
      segmenter_(segmenter),
      cursor_(trajectory, Nanoseconds(segmenter.max_gap_s)) {}

std::optional<PlacedScan> ScanPlacer::Place(const LidarScan& scan) {
  const auto lidar = static_cast<std::size_t>(scan.lidar_id);
  const SE3 T_body_lidar =
      lidar < segmenter_.T_body_lidar.size() ? segmenter_.T_body_lidar[lidar] : SE3();
  const auto turn_rad = static_cast<float>(segmenter_.vertical_correction_deg * M_PI / 180.0);
  PlacedScan placed;
  placed.lidar_id = scan.lidar_id;
  placed.points_world_m.reserve(scan.points.size());
  placed.intensities.reserve(scan.points.size());
  for (const LidarPoint& point : scan.points) {
    const double range_m = point.xyz_m.cast<double>().norm();
    if (!(range_m >= segmenter_.min_range_m && range_m <= segmenter_.max_range_m)) {  // NaN, too
      ++counts_.unusable;
      continue;
    }
    const TrajectoryCursor::Time time = cursor_.MoveTo(point.t_ns);
    counts_.outside += time == TrajectoryCursor::Time::kOutside ? 1 : 0;
    counts_.in_pause += time == TrajectoryCursor::Time::kInPause ? 1 : 0;
    if (time != TrajectoryCursor::Time::kCovered) continue;
    const Eigen::Vector3d p_body = T_body_lidar * TurnUp(point.xyz_m, turn_rad).cast<double>();
    placed.points_world_m.push_back(cursor_.ToWorld(p_body));
    placed.intensities.push_back(point.intensity);
    const bool is_first = placed.points_world_m.size() == 1;
    placed.t_ns = is_first ? point.t_ns : std::max(placed.t_ns, point.t_ns);
  }
  if (placed.points_world_m.empty()) return std::nullopt;
  counts_.placed += placed.points_world_m.size();
  placed.T_world_body = *trajectory_->At(placed.t_ns);
  return placed;
}

}  // namespace trajlo
