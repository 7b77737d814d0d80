// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "core/io/trajectory_file.h"

namespace trajlo {

/// Poses in the order of time. Rotations are orthonormal up to the digits of the file they come
/// from, and are not repaired.
struct TimedPoses {
  /// Not decreasing, one for each pose; empty if nothing is known about the times.
  std::vector<std::int64_t> t_ns;
  std::vector<Eigen::Affine3d> T_world_body;
  /// Of the file that they come from; kAuto if they come from none.
  TrajectoryFormat format = TrajectoryFormat::kAuto;

  std::size_t size() const { return T_world_body.size(); }
  bool HasStamps() const { return !t_ns.empty(); }
};

/// Which of several poses with the same stamp count: the first, the last (as in the scripts of the
/// TUM RGB-D benchmark), or all (as in evo).
enum class RepeatedStamps { kFirst, kLast, kAll };

/// Sorts by stamp (poses of the same stamp stay in the order of the file). Repeated stamps and
/// stamps that decrease are mentioned in `warnings`, in sentences that begin with `name`.
TimedPoses OrderByTime(const TrajectoryFile& file, const std::string& name,
                       RepeatedStamps repeated_stamps, std::vector<std::string>* warnings);

/// T_world_b = T_world_a T_a_b for every pose: the trajectory of a frame b that is rigidly mounted
/// on a. A lever arm is a T_a_b without rotation.
TimedPoses InFrame(TimedPoses poses, const Eigen::Affine3d& T_a_b);

/// False if all rotations are exactly the identity, as in files of a total station's positions,
/// where "0 0 0 1" fills the columns.
bool HasOrientation(const TimedPoses& poses);

/// Metres along the positions.
double PathLength(const std::vector<Eigen::Affine3d>& poses);

}  // namespace trajlo
