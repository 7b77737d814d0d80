// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/odometry/odometry.h"
#include "tests/support/synthetic_world.h"

namespace trajlo::testing {

/// All windows of a walk through a room, as they were solved.
inline std::vector<Window> SolvedWindows(const OdometryOptions& options = {}, int sweeps = 8) {
  SyntheticWorld world;
  world.T_world_body = [](double t) {
    return SE3(so3::Exp({0.02 * t, 0.0, 0.3 * t}), {0.8 * t, 0.1 * t * t, 0.0});
  };
  std::vector<Window> windows;
  Odometry odometry(options);
  odometry.OnSolvedWindow([](std::int64_t) { return true; },
                          [&](std::int64_t, const Window& window) { windows.push_back(window); });
  for (int i = 0; i < sweeps; ++i) odometry.AddScan(world.Sweep(i));
  odometry.Finish();
  return windows;
}

}  // namespace trajlo::testing
