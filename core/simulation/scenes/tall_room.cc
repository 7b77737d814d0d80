// SPDX-License-Identifier: MIT
// A tall room of 24 x 18 x 22 m with next to nothing on its walls: plainer than the atrium.
#include "core/simulation/scenes/scene_builder.h"
#include "core/simulation/scenes/scene_parts.h"

namespace trajlo::simulation {

SceneBlueprint BuildTallRoom(std::uint64_t seed) {
  constexpr double kHeight = 22.0;
  const Eigen::Vector2d low(-12.0, -9.0);
  const Eigen::Vector2d high(12.0, 9.0);
  CounterRandom random(seed, 0x7a11);
  SceneBlueprint scene;
  TriangleMesh& mesh = scene.mesh;
  AddPlate(low, high, 0.0, 0.4, &mesh);
  AddPlate(low, high, kHeight, 0.6, &mesh);
  AddPerimeter(low, high, 0.0, kHeight, 0.65, &mesh);
  // What runs from the floor to the ceiling tells nothing of the height.
  for (const double x : {-12.0, 12.0}) {
    for (const double y : {-9.0, 9.0}) {
      mesh.AddBox({x - 0.5, y - 0.5, 0.0}, {x + 0.5, y + 0.5, kHeight}, 0.5);
    }
  }
  mesh.AddCylinder({3.0, 8.6, 0.0}, {3.0, 8.6, kHeight}, 0.15, 0.5, 12);
  // One string course and a few lamps do.
  const double course = random.Uniform(9.5, 12.5);
  mesh.AddBox({-12.0, 8.75, course}, {12.0, 9.0, course + 0.3}, 0.6);
  for (int i = 0; i < 6; ++i) {
    const double side = i % 2 == 0 ? -1.0 : 1.0;
    const double x = -8.0 + 3.2 * i + random.Uniform(-1.0, 1.0);
    const double z = random.Uniform(2.5, 19.0);
    mesh.AddBox({x - 0.25, side * 8.85 - 0.15, z}, {x + 0.25, side * 8.85 + 0.15, z + 0.5}, 0.8);
  }
  mesh.AddBox({11.9, -1.0, 0.0}, {12.0, 1.0, 2.3}, 0.3);  // The door.
  mesh.AddBoxOnGround({-9.5, random.Uniform(-5.0, 5.0), 0.0}, random.Uniform(-0.3, 0.3),
                      {1.6, 0.6, 0.45}, 0.5);
  scene.routes.fly.points = {{-4.0, -3.5, 2.5}, {1.0, -4.0, 3.5}, {4.5, -2.5, 8.0},
                             {4.5, 1.5, 13.0},  {0.0, 3.5, 17.5}, {-4.0, 2.0, 12.0},
                             {-5.5, 0.0, 6.0}};
  scene.routes.walk.points = {
      {-8.0, -5.0, 0.0}, {8.0, -5.0, 0.0}, {8.0, 5.0, 0.0}, {-7.0, 5.0, 0.0}};
  scene.routes.drive = scene.routes.walk;
  return scene;
}

}  // namespace trajlo::simulation
