// SPDX-License-Identifier: MIT
#include "core/evaluation/timed_poses.h"

#include <algorithm>
#include <numeric>

namespace trajlo {

TimedPoses OrderByTime(const TrajectoryFile& file, const std::string& name,
                       RepeatedStamps repeated_stamps, std::vector<std::string>* warnings) {
  TimedPoses poses;
  poses.format = file.format;
  if (file.t_ns.empty()) {
    poses.T_world_body = file.T_world_body;
    return poses;
  }
  std::vector<std::size_t> order(file.t_ns.size());
  std::iota(order.begin(), order.end(), 0);
  if (!std::is_sorted(file.t_ns.begin(), file.t_ns.end())) {
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return file.t_ns[a] < file.t_ns[b]; });
    warnings->push_back(name + ": the stamps do not increase; the poses are sorted by time");
  }
  std::size_t repeated = 0;
  for (const std::size_t i : order) {
    if (!poses.t_ns.empty() && poses.t_ns.back() == file.t_ns[i]) {
      ++repeated;
      if (repeated_stamps == RepeatedStamps::kLast) {
        poses.T_world_body.back() = file.T_world_body[i];
      }
      if (repeated_stamps != RepeatedStamps::kAll) continue;
    }
    poses.t_ns.push_back(file.t_ns[i]);
    poses.T_world_body.push_back(file.T_world_body[i]);
  }
  if (repeated > 0) {
    warnings->push_back(name + ": stamps that repeat an earlier one: " + std::to_string(repeated) +
                        "; " +
                        (repeated_stamps == RepeatedStamps::kFirst  ? "the first one counts"
                         : repeated_stamps == RepeatedStamps::kLast ? "the last one counts"
                                                                    : "all of them count"));
  }
  return poses;
}

TimedPoses InFrame(TimedPoses poses, const Eigen::Affine3d& T_a_b) {
  for (Eigen::Affine3d& T : poses.T_world_body) T = T * T_a_b;
  return poses;
}

bool HasOrientation(const TimedPoses& poses) {
  return std::any_of(
      poses.T_world_body.begin(), poses.T_world_body.end(),
      [](const Eigen::Affine3d& T) { return T.linear() != Eigen::Matrix3d::Identity(); });
}

double PathLength(const std::vector<Eigen::Affine3d>& poses) {
  double length = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    length += (poses[i].translation() - poses[i - 1].translation()).norm();
  }
  return length;
}

}  // namespace trajlo
