// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/io/trajectory_reader.h"
#include "tests/apps/command_testing.h"
#include "tests/support/room_recording.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {

inline Outcome Call(const std::vector<std::string>& arguments, rlim_t max_file_bytes = 0) {
  return CallProgram(TRAJLO_RUN, arguments, max_file_bytes);
}

/// A recording in `input` and room for a result in `output`.
class TrajloRunTest : public ::testing::Test {
 protected:
  std::string input() const { return (temp_ / "in").string(); }
  std::string output() const { return (temp_ / "out").string(); }
  std::filesystem::path Result(const std::string& name) const { return temp_ / "out" / name; }

  Outcome Run(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"--input=" + input(), "--output=" + output()});
    return Call(more);
  }

  nlohmann::json RunJson() const { return nlohmann::json::parse(ReadFile(Result("run.json"))); }
  std::vector<StampedPose> Trajectory() const { return ReadTum(Result("trajectory.tum")); }

  TempFolder temp_;
};

}  // namespace trajlo::testing
