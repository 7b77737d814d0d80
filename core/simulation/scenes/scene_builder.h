// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/simulation/motions/motion.h"
#include "core/simulation/scenes/scene.h"
#include "core/simulation/scenes/triangle_mesh.h"

namespace trajlo::simulation {

/// What a scene is made of, and the ways through it. World frame: z up, metres.
struct SceneBlueprint {
  TriangleMesh mesh;
  std::vector<MovingObject> moving_objects;
  SceneRoutes routes;
};

/// Builds a scene by name; the same seed gives the same scene. Throws std::invalid_argument for an
/// unknown name.
SceneBlueprint BuildScene(const std::string& name, std::uint64_t seed);

/// The names that BuildScene knows.
std::vector<std::string> SceneNames();

/// The builders, one for each scene.
SceneBlueprint BuildAtrium(std::uint64_t seed);
SceneBlueprint BuildCarPark(std::uint64_t seed);
SceneBlueprint BuildConstructionSite(std::uint64_t seed);
SceneBlueprint BuildCorridor(std::uint64_t seed);
SceneBlueprint BuildCourtyard(std::uint64_t seed);
SceneBlueprint BuildFacade(std::uint64_t seed);
SceneBlueprint BuildForest(std::uint64_t seed);
SceneBlueprint BuildHall(std::uint64_t seed);
SceneBlueprint BuildLongFacade(std::uint64_t seed);
SceneBlueprint BuildManhattan(std::uint64_t seed);
SceneBlueprint BuildMotorway(std::uint64_t seed);
SceneBlueprint BuildOffice(std::uint64_t seed);
SceneBlueprint BuildSquare(std::uint64_t seed);
SceneBlueprint BuildStairwell(std::uint64_t seed);
SceneBlueprint BuildStreet(std::uint64_t seed);
SceneBlueprint BuildTallRoom(std::uint64_t seed);

}  // namespace trajlo::simulation
