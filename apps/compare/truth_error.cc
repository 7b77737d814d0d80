// SPDX-License-Identifier: MIT
#include "apps/compare/truth_error.h"

#include "core/evaluation/evaluation.h"

namespace trajlo {

TimedPoses ReadTruth(const std::filesystem::path& path) {
  std::vector<std::string> warnings;
  const TrajectoryFile file = ReadTrajectory(path, TrajectoryFormat::kAuto, &warnings);
  return OrderByTime(file, path.string(), RepeatedStamps::kFirst, &warnings);
}

double PositionError(const TimedPoses& truth, const std::vector<StampedPose>& estimate) {
  TimedPoses poses;
  for (const StampedPose& pose : estimate) {
    Eigen::Affine3d T(pose.T_world_body.q);
    T.pretranslate(pose.T_world_body.t);
    poses.t_ns.push_back(pose.t_ns);
    poses.T_world_body.push_back(T);
  }
  return Evaluate(poses, truth, {}).absolute.translation_m.rmse;
}

}  // namespace trajlo
