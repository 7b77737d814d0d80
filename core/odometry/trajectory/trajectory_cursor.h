// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/odometry/trajectory/trajectory.h"
#include "manifolds/se3_interpolation.h"

namespace trajlo {

/// Takes points to the world, each by the pose at its own time. Fast where most times lie between
/// the same two control poses as the one before.
class TrajectoryCursor {
 public:
  enum class Time {
    kCovered,
    kOutside,  ///< Before the first pose or after the last one.
    kInPause,  ///< Between poses that are farther apart than `max_gap_ns`: nobody knows the motion.
  };

  /// `trajectory` must outlive it and not change.
  TrajectoryCursor(const Trajectory* trajectory, std::int64_t max_gap_ns)
      : trajectory_(trajectory), max_gap_ns_(max_gap_ns) {}

  /// Goes to a time. A control pose itself is covered, even at the end of a pause.
  Time MoveTo(std::int64_t t_ns);
  /// A point in the body frame, at the time of the last MoveTo(), which was covered.
  Eigen::Vector3d ToWorld(const Eigen::Vector3d& p_body) const {
    return motion_.ToWorld(alpha_, p_body);
  }

 private:
  const Trajectory* trajectory_;
  std::int64_t max_gap_ns_;
  std::int64_t begin_ns_ = 0, end_ns_ = 0;  ///< No time lies between them at first.
  SegmentMotion motion_{SE3(), SE3()};
  double alpha_ = 0.0;
};

}  // namespace trajlo
