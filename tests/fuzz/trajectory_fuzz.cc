// SPDX-License-Identifier: MIT
// Trajectories of every format, each told by itself and by name.
#include "core/io/errors.h"
#include "core/io/trajectory_file.h"
#include "core/io/trajectory_reader.h"
#include "tests/fuzz/fuzzing.h"

namespace {

void RequireSound(const trajlo::TrajectoryFile& file) {
  using trajlo::fuzz::Require;
  Require(!file.T_world_body.empty(), "a trajectory that is read has poses");
  Require(file.t_ns.empty() || file.t_ns.size() == file.T_world_body.size(),
          "every pose has a stamp, or none has");
  for (const Eigen::Affine3d& T : file.T_world_body) {
    // By their numbers: the length of one that has flown off to 1e200 m is not.
    Require(T.matrix().allFinite(), "poses are finite");
    const Eigen::Matrix3d error = T.linear().transpose() * T.linear() - Eigen::Matrix3d::Identity();
    Require(error.cwiseAbs().maxCoeff() < 2e-4, "rotations are rotations");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trajlo;
  static const fuzz::ScratchFile file("input.txt");
  const auto& path = file.Write(fuzz::AsText(data, size));
  for (const auto format : {TrajectoryFormat::kAuto, TrajectoryFormat::kTum,
                            TrajectoryFormat::kKitti, TrajectoryFormat::kEuroc}) {
    std::vector<std::string> warnings;
    try {
      RequireSound(ReadTrajectory(path, format, &warnings));
    } catch (const InputError&) {
    }
  }
  return 0;
}
