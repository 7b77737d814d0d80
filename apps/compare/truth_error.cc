// SPDX-License-Identifier: MIT
#include "apps/compare/truth_error.h"

#include "core/evaluation/evaluation.h"
#include "core/evaluation/evaluation_error.h"

namespace trajlo {
namespace {

TimedPoses ToTimedPoses(const std::vector<StampedPose>& estimate) {
  TimedPoses poses;
  for (const StampedPose& pose : estimate) {
    Eigen::Affine3d T(pose.T_world_body.q);
    T.pretranslate(pose.T_world_body.t);
    poses.t_ns.push_back(pose.t_ns);
    poses.T_world_body.push_back(T);
  }
  return poses;
}

/// The flags that such a text advises are those of trajlo_evaluate.
std::string WithProgramOfFlags(std::string text) {
  constexpr char kProgram[] = "trajlo_evaluate ";
  std::size_t at = 0;
  while ((at = text.find("--", at)) != std::string::npos) {
    const bool begins_a_word = at == 0 || text[at - 1] == ' ' || text[at - 1] == '(';
    if (begins_a_word) {
      text.insert(at, kProgram);
      at += sizeof(kProgram) - 1;
    }
    at += 2;
  }
  return text;
}

}  // namespace

TimedPoses ReadTruth(const std::filesystem::path& path, std::vector<std::string>* warnings) {
  const TrajectoryFile file = ReadTrajectory(path, TrajectoryFormat::kAuto, warnings);
  return OrderByTime(file, path.string(), RepeatedStamps::kFirst, warnings);
}

TruthError CompareWithTruth(const TimedPoses& truth, const std::vector<StampedPose>& estimate) {
  TruthError error;
  EvaluationOptions options;
  options.doubt_rotations = false;
  try {
    const Evaluation evaluation = Evaluate(ToTimedPoses(estimate), truth, options);
    error.ate_rmse_m = evaluation.absolute.translation_m.rmse;
    error.pairs = evaluation.pairs.size();
    error.covered_share = evaluation.covered_share;
    for (const std::string& warning : evaluation.warnings) {
      error.warnings.push_back(WithProgramOfFlags(warning));
    }
  } catch (const EvaluationError& failure) {
    error.failure = WithProgramOfFlags(failure.what());
  }
  return error;
}

}  // namespace trajlo
