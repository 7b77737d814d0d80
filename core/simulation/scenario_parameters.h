// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/simulation/scenario.h"

namespace trajlo::simulation {

/// A number and the range that it may be set to, both ends included.
template <typename T>
struct Bounded {
  T* value;
  T least, greatest;
};

/// A word and what it may be set to; empty: anything.
struct Word {
  std::string* value;
  std::vector<std::string> choices;
};

/// One number or word of a scenario that can be read and set by name. The one list of these serves
/// the command line, scenario.yaml and error messages.
struct Parameter {
  /// `motion.speed_mps`, `lidar0.range_sigma_m`, `seed`.
  std::string key;
  std::variant<Bounded<double>, Bounded<int>, Bounded<std::int64_t>, Bounded<std::uint64_t>, bool*,
               Word, SE3*>
      value;
};

/// Longer recordings are a mistake in the unit: their list of sweeps alone would fill the memory.
constexpr double kLongestDuration_s = 86'400.0;
constexpr double kShortestDuration_s = 0.001;

/// All parameters of a scenario, in the order in which they are written. The pointers are into
/// `scenario`.
std::vector<Parameter> Parameters(Scenario* scenario);

/// Sets a parameter from text. `lidar.KEY` sets it for all LiDARs; an SE3 is `x,y,z,qx,qy,qz,qw` in
/// metres. A new sensor brings its own measurement model. Throws std::invalid_argument that says
/// what is wrong and what is allowed, with the nearest key if there is no such key.
void SetParameter(Scenario* scenario, const std::string& key, const std::string& text);

/// Sets several: first the sensors, so that what is said of a measurement model holds for the new
/// one, then the others in their order.
void SetParameters(Scenario* scenario, std::vector<std::pair<std::string, std::string>> settings);

/// The value as text that SetParameter reads back.
std::string ParameterText(const Parameter& parameter);

/// The words that the parameter may be; empty for numbers and where any text may stand.
std::vector<std::string> ChoicesOf(const Parameter& parameter);

}  // namespace trajlo::simulation
