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
      max_gap_ns_(Nanoseconds(segmenter.max_gap_s)) {}

std::optional<PlacedScan> ScanPlacer::Place(const LidarScan& scan) {
  const auto lidar = static_cast<std::size_t>(scan.lidar_id);
  const SE3 T_body_lidar =
      lidar < segmenter_.T_body_lidar.size() ? segmenter_.T_body_lidar[lidar] : SE3();
  const auto turn_rad = static_cast<float>(segmenter_.vertical_correction_deg * M_PI / 180.0);
  PlacedScan placed;
  placed.lidar_id = scan.lidar_id;
  placed.points_world_m.reserve(scan.points.size());
  placed.intensities.reserve(scan.points.size());
  motions_.clear();
  for (const LidarPoint& point : scan.points) {
    const double range_m = point.xyz_m.cast<double>().norm();
    if (!(range_m >= segmenter_.min_range_m && range_m <= segmenter_.max_range_m)) {  // NaN, too
      ++counts_.unusable;
      continue;
    }
    double alpha = 0.0;
    const SegmentMotion* motion = MotionAt(point.t_ns, &alpha);
    if (motion == nullptr) continue;
    const Eigen::Vector3d p_body = T_body_lidar * TurnUp(point.xyz_m, turn_rad).cast<double>();
    placed.points_world_m.push_back(motion->ToWorld(alpha, p_body));
    placed.intensities.push_back(point.intensity);
    const bool is_first = placed.points_world_m.size() == 1;
    placed.t_ns = is_first ? point.t_ns : std::max(placed.t_ns, point.t_ns);
  }
  if (placed.points_world_m.empty()) return std::nullopt;
  counts_.placed += placed.points_world_m.size();
  placed.T_world_body = *trajectory_->At(placed.t_ns);
  return placed;
}

/// Null, and counted, if the time lies in no segment.
const SegmentMotion* ScanPlacer::MotionAt(std::int64_t t_ns, double* alpha) {
  const std::vector<ControlPose>& poses = trajectory_->poses();
  if (t_ns < poses.front().t_ns || t_ns > poses.back().t_ns) {
    ++counts_.outside;
    return nullptr;
  }
  if (!IsInSegment(end_, t_ns)) {
    const auto found =
        std::lower_bound(poses.begin(), poses.end(), t_ns,
                         [](const ControlPose& pose, std::int64_t t) { return pose.t_ns < t; });
    end_ = std::max<std::size_t>(1, static_cast<std::size_t>(found - poses.begin()));
  }
  // A single pose is a segment without length.
  const ControlPose& end = poses[std::min(end_, poses.size() - 1)];
  const ControlPose& begin = poses[std::min(end_ - 1, poses.size() - 1)];
  const std::int64_t duration_ns = end.t_ns - begin.t_ns;
  const bool is_between = t_ns > begin.t_ns && t_ns < end.t_ns;
  if (is_between && duration_ns > max_gap_ns_) {
    ++counts_.in_pause;
    return nullptr;
  }
  *alpha = duration_ns > 0
               ? static_cast<double>(t_ns - begin.t_ns) / static_cast<double>(duration_ns)
               : 1.0;
  return &motions_.try_emplace(end_, begin.T_world_body, end.T_world_body).first->second;
}

bool ScanPlacer::IsInSegment(std::size_t end, std::int64_t t_ns) const {
  const std::vector<ControlPose>& poses = trajectory_->poses();
  return end < poses.size() && poses[end - 1].t_ns < t_ns && t_ns <= poses[end].t_ns;
}

}  // namespace trajlo
