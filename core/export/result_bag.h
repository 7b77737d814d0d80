// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/export/run_result.h"
#include "core/export/scan_placer.h"
#include "core/export/surface_map.h"
#include "core/io/messages/bag_writer.h"

namespace trajlo {

/// In which frame deskewed points are given.
enum class PointFrame {
  kBody,  ///< Of the body at the scan's stamp, which is that of its last point; /tf says where.
  kWorld
};

/// What turns points of the world into that frame.
inline SE3 FrameFromWorld(PointFrame frame, const SE3& T_world_body) {
  return frame == PointFrame::kBody ? T_world_body.Inverse() : SE3();
}

/// Writes a result as messages that viewers know:
///
///   /tf               world -> body, at every pose and at the stamp of every scan
///   /tf_static        body -> lidar0, ...
///   /odometry         nav_msgs/Odometry of every pose, with covariance and velocity
///   /path             all poses
///   /points_deskewed  sensor_msgs/PointCloud2 of every scan; several LiDARs: /lidar0/...
///   /map              the whole run's
///
/// Messages are stamped and recorded when their poses hold; /tf_static, /path and /map at the
/// start, and are latched. Points have no times of their own: nobody shall deskew them again.
class ResultBag {
 public:
  /// All must outlive this.
  ResultBag(const RunResult& result, PointFrame frame, std::size_t lidars, BagWriter* bag);

  /// Scans in the order of their stamps, or nearly so.
  void WriteScan(const PlacedScan& scan);
  /// Viewers must hold the map at once: of more than two million surfels every second, third, ...
  /// is written. Returns how many.
  std::size_t WriteMap(const std::vector<Surfel>& surfels);
  /// What is left of the poses. The bag is left open.
  void Finish();

 private:
  void WriteStaticFrames(std::size_t lidars);
  void WritePath();
  void WritePosesUntil(std::int64_t t_ns);
  const Matrix6d& NearestCovariance(std::int64_t t_ns) const;
  void WritePose(std::size_t index);
  void WriteTransform(std::int64_t t_ns, const SE3& T_world_body);
  std::int64_t begin_ns() const { return result_.trajectory.poses().front().t_ns; }

  const RunResult& result_;
  PointFrame frame_;
  std::vector<TopicDescription> scan_topics_;
  BagWriter* bag_;
  std::size_t next_pose_ = 0;
};

}  // namespace trajlo
