// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/simulation/simulator.h"

namespace trajlo::simulation {

/// The scene and the true path from above, as SVG: what a horizontal plane at the mean height of
/// the path cuts (dark) and what one near the lowest point of the path cuts (light), the path in
/// colour with a dot at its start, and a scale.
std::string ScenePicture(const Simulator& simulator);

}  // namespace trajlo::simulation
