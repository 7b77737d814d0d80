// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/simulation/motions/motion.h"

/// The makers behind MakeMotion, one for each kind.
namespace trajlo::simulation {

PoseFunction MakeWalk(const MotionConfig& config, const SceneRoutes& routes, double duration_s,
                      std::uint64_t seed);
PoseFunction MakeFlight(const MotionConfig& config, const SceneRoutes& routes, double duration_s,
                        std::uint64_t seed);
PoseFunction MakeDrive(const MotionConfig& config, const SceneRoutes& routes, double duration_s,
                       std::uint64_t seed);
PoseFunction MakeBursts(const MotionConfig& config, const SceneRoutes& routes, double duration_s,
                        std::uint64_t seed);
PoseFunction MakeGlances(const MotionConfig& config, const SceneRoutes& routes, double duration_s,
                         std::uint64_t seed);
PoseFunction MakeSpin(const MotionConfig& config, const SceneRoutes& routes, std::uint64_t seed);
PoseFunction MakeSwing(const MotionConfig& config, const SceneRoutes& routes, std::uint64_t seed);
PoseFunction MakeTwist(const MotionConfig& config, const SceneRoutes& routes, std::uint64_t seed);
PoseFunction MakeStill(const SceneRoutes& routes);
PoseFunction MakeReplay(const MotionConfig& config, const SceneRoutes& routes, double duration_s);

/// Where the flying route starts, `height_m` above the ground, heading along the route.
SE3 SpotOfFlight(const SceneRoutes& routes, double height_m);

}  // namespace trajlo::simulation
