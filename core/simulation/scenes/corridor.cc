// SPDX-License-Identifier: MIT
// A corridor of 60 x 2.4 x 2.6 m with recessed doors: little to hold on to along its axis.
#include "core/simulation/scenes/scene_builder.h"
#include "core/simulation/scenes/scene_parts.h"

namespace trajlo::simulation {

SceneBlueprint BuildCorridor(std::uint64_t seed) {
  constexpr double kHalfLength = 30.0;
  constexpr double kHalfWidth = 1.2;
  constexpr double kHeight = 2.6;
  CounterRandom random(seed, 0xc0441d04);
  SceneBlueprint scene;
  TriangleMesh& mesh = scene.mesh;
  AddPlate({-kHalfLength, -2.0}, {kHalfLength, 2.0}, 0.0, 0.3, &mesh);
  AddPlate({-kHalfLength, -2.0}, {kHalfLength, 2.0}, kHeight, 0.7, &mesh);
  for (const double side : {-1.0, 1.0}) {
    std::vector<Opening> doors;
    const double depth = random.Uniform(0.15, 0.25);
    double x = random.Uniform(2.0, 5.0);
    while (x < 2.0 * kHalfLength - 3.0) {
      doors.push_back({x, x + 1.0, 0.0, 2.1});
      x += random.Uniform(4.0, 8.0);
    }
    const double y = side * (kHalfWidth + 0.5 * depth);
    AddWall({-kHalfLength, y}, {kHalfLength, y}, 0.0, kHeight, depth, doors, 0.7, &mesh);
    // The leaves of the doors, at the back of the recesses.
    const double leaf = side * (kHalfWidth + depth);
    mesh.AddQuad({-kHalfLength, leaf, 0.0}, {kHalfLength, leaf, 0.0}, {kHalfLength, leaf, kHeight},
                 {-kHalfLength, leaf, kHeight}, 0.4);
  }
  for (const double x : {-kHalfLength, kHalfLength}) {
    mesh.AddBox({x - 0.1, -2.0, 0.0}, {x + 0.1, 2.0, kHeight}, 0.7);
  }
  for (const double x : EvenlySpaced(-27.0, 27.0, 6.0)) {
    mesh.AddBox({x - 0.6, -0.1, kHeight - 0.07}, {x + 0.6, 0.1, kHeight}, 0.9);
  }
  for (const double x : {-19.0, 5.0, 21.0}) {
    mesh.AddBox({x, 1.05, 0.9}, {x + 0.3, 1.2, 1.5}, 0.5);  // A fire extinguisher's cabinet.
  }
  scene.routes.walk.points = {{-27.0, 0.0, 0.0}, {27.0, 0.0, 0.0}};
  scene.routes.walk.closed = false;
  scene.routes.drive = scene.routes.walk;
  scene.routes.fly = scene.routes.walk;
  for (Eigen::Vector3d& p : scene.routes.fly.points) p.z() = 1.3;
  return scene;
}

}  // namespace trajlo::simulation
