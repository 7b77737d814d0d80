// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/simulation/scenario.h"

namespace trajlo::simulation {

/// The scenario as YAML: every parameter under its key, one nested level for `group.name`, and each
/// extrinsic also as a row-major 4x4 matrix.
std::string ScenarioYaml(const Scenario& scenario);

/// The true extrinsics as a config file for `trajlo_run --config=`.
std::string RigYaml(const Scenario& scenario);

}  // namespace trajlo::simulation
