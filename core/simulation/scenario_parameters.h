// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "core/simulation/scenario.h"

namespace trajlo::simulation {

/// One number or word of a scenario that can be read and set by name. The one list of these serves
/// the command line, scenario.yaml and error messages.
struct Parameter {
  /// `motion.speed_mps`, `lidar0.range_sigma_m`, `seed`.
  std::string key;
  std::variant<double*, int*, bool*, std::int64_t*, std::uint64_t*, std::string*, SE3*> value;
};

/// All parameters of a scenario, in the order in which they are written. The pointers are into
/// `scenario`.
std::vector<Parameter> Parameters(Scenario* scenario);

/// Sets a parameter from text. `lidar.KEY` sets it for all LiDARs; an SE3 is `x,y,z,qx,qy,qz,qw` in
/// metres. A new sensor brings its own measurement model. Throws std::invalid_argument that says
/// what is wrong, with the nearest key if there is no such key.
void SetParameter(Scenario* scenario, const std::string& key, const std::string& text);

/// The value as text that SetParameter reads back.
std::string ParameterText(const Parameter& parameter);

}  // namespace trajlo::simulation
