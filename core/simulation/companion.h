// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/simulation/motions/pose_function.h"
#include "core/simulation/scenes/scene.h"

namespace trajlo::simulation {

/// Something that goes wherever the body goes, and stays in the view of its LiDARs.
struct CompanionConfig {
  /// none, person (who carries the sensor, or walks along), car and truck (in the next lane), or
  /// roof (of the car under the sensor).
  std::string kind = "none";
  /// Where it stands, seen from the body: along its heading, across it, and how far below.
  double ahead_m = -0.7;
  double left_m = 0.0;
  double below_m = 1.3;
  /// It sways to and fro along both axes, at most by this, and so often.
  double sway_m = 0.0;
  double sway_hz = 1.8;
};

/// The companion of a body that moves so. It stands upright and turns with the body's heading; a
/// roof tilts with the body as well.
MovingObject MakeCompanion(const CompanionConfig& config, PoseFunction T_world_body);

/// The kinds of companions, none among them.
std::vector<std::string> CompanionKinds();

}  // namespace trajlo::simulation
