// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "manifolds/se3.h"

namespace trajlo::simulation {

/// A motion: the exact pose T_world_body (or T_world_object) at any time. `t_s` counts seconds from
/// the start of the recording; the world frame is the scene's, z up. At least twice differentiable,
/// and safe to call from many threads.
using PoseFunction = std::function<SE3(double t_s)>;

}  // namespace trajlo::simulation
