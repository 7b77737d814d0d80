// SPDX-License-Identifier: MIT
#include "core/simulation/motions/motion.h"

#include <stdexcept>

#include "core/simulation/motions/motion_makers.h"
#include "core/simulation/motions/pace.h"

namespace trajlo::simulation {

PoseFunction MakeMotion(const MotionConfig& config, const SceneRoutes& routes, double duration_s,
                        std::uint64_t seed) {
  CheckPace(config);
  if (config.kind == "walk") return MakeWalk(config, routes, duration_s, seed);
  if (config.kind == "flight") return MakeFlight(config, routes, duration_s, seed);
  if (config.kind == "drive") return MakeDrive(config, routes, duration_s, seed);
  if (config.kind == "bursts") return MakeBursts(config, routes, duration_s, seed);
  if (config.kind == "glances") return MakeGlances(config, routes, duration_s, seed);
  if (config.kind == "spin") return MakeSpin(config, routes, seed);
  if (config.kind == "swing") return MakeSwing(config, routes, seed);
  if (config.kind == "twist") return MakeTwist(config, routes, seed);
  if (config.kind == "still") return MakeStill(routes);
  if (config.kind == "replay") return MakeReplay(config, routes, duration_s);
  throw std::invalid_argument("unknown motion '" + config.kind + "'");
}

std::vector<std::string> MotionKinds() {
  return {"walk",   "flight",  "drive", "spin",   "swing",
          "bursts", "glances", "twist", "replay", "still"};
}

}  // namespace trajlo::simulation
