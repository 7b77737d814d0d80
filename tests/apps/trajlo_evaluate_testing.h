// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/io/trajectory_writer.h"
#include "tests/apps/command_testing.h"
#include "tests/core/evaluation/synthetic_poses.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {

/// A truth, and estimates of it that are right, worse and lost.
class TrajloEvaluateTest : public ::testing::Test {
 protected:
  void SetUp() override {
    WritePoses("truth.tum", SmoothPoses(0.0, 0.02, 1000));
    WritePoses("good.tum", Disturbed(0.01));
    WritePoses("worse.tum", Disturbed(0.2));
    WritePoses("lost.tum", Disturbed(40.0));
  }

  /// Poses of the truth's motion, every other one off by this much in x.
  static TimedPoses Disturbed(double error_m) {
    TimedPoses poses = SmoothPoses(1.0, 0.1, 180);
    for (std::size_t i = 0; i < poses.size(); i += 2) {
      poses.T_world_body[i].translation().x() += error_m;
    }
    return poses;
  }

  std::string Path(const std::string& name) const { return (temp_ / name).string(); }

  void WritePoses(const std::string& name, const TimedPoses& poses) const {
    TumWriter writer(temp_ / name, IfExists::kReplace);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      writer.Append(poses.t_ns[i], SE3(Eigen::Quaterniond(poses.T_world_body[i].linear()),
                                       poses.T_world_body[i].translation()));
    }
    writer.Close();
  }

  /// Names of files stand for those of the temporary folder.
  Outcome Call(const std::vector<std::string>& arguments, rlim_t max_file_bytes = 0) const {
    std::vector<std::string> whole;
    for (const std::string& argument : arguments) {
      whole.push_back(argument.rfind("--", 0) == 0 ? argument : Path(argument));
    }
    return CallProgram(TRAJLO_EVALUATE, whole, max_file_bytes);
  }

  std::string Output() const { return "--output=" + Path("out"); }
  nlohmann::json Json() const {
    return nlohmann::json::parse(ReadFile(temp_ / "out/evaluation.json"));
  }

  TempFolder temp_;
};

}  // namespace trajlo::testing
