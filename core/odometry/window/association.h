// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/odometry/map/map_pyramid.h"
#include "core/odometry/parallel/thread_pool.h"
#include "core/odometry/segments/segment_cloud.h"
#include "core/odometry/window/lidar_path.h"
#include "core/odometry/window/step_size.h"
#include "factors/registration_point.h"
#include "manifolds/se3_interpolation.h"

namespace trajlo {

/// Whether `associated` is `point` with its plane. Points that have a plane are in the order of
/// all.
inline bool IsSamePoint(const RegistrationPoint& associated, const SegmentPoint& point) {
  return associated.p_body_m == point.p_body_m.cast<double>() && associated.alpha == point.alpha;
}

/// The planes of one segment's points. A point keeps its plane until it leaves its cell of the map,
/// or the map has grown by as many points as the segment has: behind a fast body the first planes
/// are those of few points. One without a plane asks again when the map has grown at all. None is
/// asked while the segment moves less than a tolerance.
class SegmentAssociation {
 public:
  /// Takes every registration point to the world at its own time on T_begin..T_end, where Look()
  /// will look up the planes of those that need one. `cloud` is the same at every call; it and
  /// `map` must live until Finish(). Returns in how many chunks: none where the poses are within
  /// `tolerance` of where they were.
  std::size_t Begin(const SegmentCloud& cloud, const SE3& T_begin, const SE3& T_end,
                    const MapPyramid& map, const StepSize& tolerance);
  /// Every chunk once, in any order; several threads may.
  void Look(std::size_t chunk);
  /// `associated` receives the points that have a plane, in the order of the points; it stays as it
  /// is where nothing was looked up. Returns the number of look-ups.
  int Finish(std::vector<RegistrationPoint>* associated);

  /// The three in a row, without a tolerance.
  int Associate(const SegmentCloud& cloud, const SE3& T_begin, const SE3& T_end,
                const MapPyramid& map, ThreadPool* threads,
                std::vector<RegistrationPoint>* associated);

 private:
  /// From Begin() to Finish().
  struct Round {
    const std::vector<SegmentPoint>* points;
    const MapPyramid* map;
    bool has_grown;  ///< The map, since the last round.
    bool asks_all;   ///< Also the points that have a plane.
    SegmentMotion motion;
    std::vector<LidarPath> lidars;
    std::vector<int> searched;  ///< In each chunk.
  };

  /// Of each point: the cell in which it asked, and the answer.
  std::vector<VoxelKey> cells_;
  std::vector<Plane> planes_;
  /// In the last round.
  SE3 T_begin_, T_end_;
  /// MapPyramid::inserted(), in the last round and in the last one that asked for all.
  std::int64_t inserted_ = -1, inserted_at_all_ = 0;
  std::optional<Round> round_;
};

}  // namespace trajlo
