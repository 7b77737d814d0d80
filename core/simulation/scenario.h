// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/simulation/companion.h"
#include "core/simulation/faults.h"
#include "core/simulation/motions/motion.h"
#include "core/simulation/rig.h"

namespace trajlo::simulation {

/// Everything that decides a simulated recording: scene x rig x motion x faults.
struct Scenario {
  std::string name;
  std::string description;
  /// See BuildScene.
  std::string scene = "hall";
  bool moving_objects = false;
  std::vector<LidarConfig> rig;
  MotionConfig motion;
  CompanionConfig companion;
  FaultConfig faults;
  /// Scans corrected by the true motion to the pose at the middle of their sweep, without point
  /// times, as in KITTI's odometry benchmark.
  bool motion_corrected = false;
  double duration_s = 15.0;
  /// The stamp of the start of the recording.
  std::int64_t start_time_ns = 1'700'000'000'000'000'000;
  /// Decides noise, faults, shaking and the details of the scene.
  std::uint64_t seed = 1;
};

/// A scenario by name. Throws std::invalid_argument for an unknown one.
Scenario MakeScenario(const std::string& name);

/// The names that MakeScenario knows.
std::vector<std::string> ScenarioNames();

}  // namespace trajlo::simulation
