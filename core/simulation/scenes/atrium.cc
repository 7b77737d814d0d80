// SPDX-License-Identifier: MIT
// A tall atrium of plain walls, 22 x 16 x 26 m: what a horizontal LiDAR sees hardly changes with
// its height.
#include "core/simulation/scenes/scene_builder.h"
#include "core/simulation/scenes/scene_parts.h"

namespace trajlo::simulation {

SceneBlueprint BuildAtrium(std::uint64_t seed) {
  CounterRandom random(seed, 0xa7414);
  SceneBlueprint scene;
  TriangleMesh& mesh = scene.mesh;
  AddPlate({-11.0, -8.0}, {11.0, 8.0}, 0.0, 0.4, &mesh);
  AddPlate({-11.0, -8.0}, {11.0, 8.0}, 26.0, 0.5, &mesh);
  AddPerimeter({-11.0, -8.0}, {11.0, 8.0}, 0.0, 26.0, 0.65, &mesh);
  // Two ledges and a bridge are all that tells one height from another.
  mesh.AddBox({-11.0, 7.2, 8.0}, {11.0, 8.0, 8.3}, 0.6);
  mesh.AddBox({10.2, -8.0, 16.0}, {11.0, 8.0, 16.3}, 0.6);
  mesh.AddBox({-9.5, -8.0, 12.0}, {-7.5, 8.0, 12.3}, 0.5);
  for (const double x : {-6.0, 0.0, 6.0}) {
    mesh.AddBox({x - 1.0, -8.0, 0.0}, {x + 1.0, -7.85, 2.4}, 0.3);
  }
  for (int i = 0; i < 5; ++i) {
    mesh.AddBoxOnGround({random.Uniform(-9.0, 9.0), random.Uniform(5.0, 7.0), 0.0},
                        random.Uniform(0.0, 1.5), {1.6, 0.8, random.Uniform(0.5, 1.2)}, 0.5);
  }
  mesh.AddCylinder({8.5, 5.5, 0.0}, {8.5, 5.5, 26.0}, 0.4, 0.6);
  scene.routes.fly.points = {
      {-4.0, -3.0, 4.0}, {4.0, -3.5, 8.0}, {5.5, 1.5, 13.0}, {0.0, 3.5, 19.0}, {-4.5, 1.0, 12.0}};
  scene.routes.walk.points = {
      {-8.0, -5.0, 0.0}, {8.0, -5.0, 0.0}, {7.0, 2.5, 0.0}, {-8.0, 2.5, 0.0}};
  scene.routes.drive = scene.routes.walk;
  return scene;
}

}  // namespace trajlo::simulation
