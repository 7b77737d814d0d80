// SPDX-License-Identifier: MIT
// A big hall of 40 x 25 x 10 m: pillars, roof girders, machines, crates and partitions.
#include "core/simulation/scenes/scene_builder.h"
#include "core/simulation/scenes/scene_parts.h"

namespace trajlo::simulation {

SceneBlueprint BuildHall(std::uint64_t seed) {
  CounterRandom random(seed, 0x4a11);
  SceneBlueprint scene;
  TriangleMesh& mesh = scene.mesh;
  AddPlate({-20.0, -12.5}, {20.0, 12.5}, 0.0, 0.4, &mesh);
  AddPlate({-20.0, -12.5}, {20.0, 12.5}, 10.0, 0.5, &mesh);
  AddPerimeter({-20.0, -12.5}, {20.0, 12.5}, 0.0, 10.0, 0.6, &mesh);
  // Gates and pilasters give the walls relief.
  for (const double x : {-14.0, 2.0, 13.0}) {
    mesh.AddBox({x - 2.0, -12.5, 0.0}, {x + 2.0, -12.2, 4.5}, 0.3);
    mesh.AddBox({x - 0.4, 12.0, 0.0}, {x + 0.4, 12.5, 10.0}, 0.6);
  }
  for (int i = 0; i < 7; ++i) {
    const double x = -18.0 + 6.0 * i;
    mesh.AddBox({x - 0.15, -12.5, 9.0}, {x + 0.15, 12.5, 9.6}, 0.5);
  }
  for (const double x : {-12.0, -4.0, 4.0, 12.0}) {
    for (const double y : {-8.0, 8.0}) {
      mesh.AddBox({x - 0.3, y - 0.3, 0.0}, {x + 0.3, y + 0.3, 10.0}, 0.6);
    }
  }
  // The ring between the middle and the walls is where things stand; the flying route passes over
  // or beside them.
  for (int i = 0; i < 7; ++i) {
    AddMachine({-16.5 + 5.5 * i, random.Uniform(9.6, 10.4), 0.0}, random.Uniform(-0.2, 0.2),
               &random, &mesh);
  }
  for (int i = 0; i < 12; ++i) {
    const double size = random.Uniform(0.6, 1.8);
    mesh.AddBoxOnGround({random.Uniform(-17.0, 17.0), random.Uniform(-11.0, -9.3), 0.0},
                        random.Uniform(-0.8, 0.8), {size, random.Uniform(0.6, 1.8), size}, 0.5);
  }
  for (const double x : {-7.5, 8.0}) {
    AddWall({x, -2.5}, {x + 1.5, 2.5}, 0.0, 2.4, 0.12, {{2.0, 3.0, 0.0, 2.1}}, 0.7, &mesh);
    AddShelf({x - 2.5, 0.0, 0.0}, 1.57, {3.0, 0.8, 2.6}, 5, &mesh);
  }
  AddMachine({0.0, 0.0, 0.0}, 0.5, &random, &mesh);
  mesh.AddCylinder({-18.0, 5.0, 0.0}, {-18.0, 5.0, 6.0}, 1.2, 0.6, 32);
  mesh.AddCylinder({-20.0, -6.0, 7.0}, {20.0, -6.0, 7.0}, 0.25, 0.6, 16);

  scene.routes.fly.points = {
      {-15.0, -5.0, 3.0}, {-8.0, -5.5, 3.5}, {0.0, -5.0, 4.2}, {9.0, -5.5, 5.0}, {15.5, -3.0, 4.5},
      {16.0, 3.0, 3.6},   {9.0, 5.5, 3.0},   {1.0, 4.5, 3.8},  {-7.0, 5.5, 5.2}, {-14.0, 4.0, 4.6}};
  scene.routes.walk.points = {
      {-15.0, -5.0, 0.0}, {15.0, -5.0, 0.0}, {15.0, 5.0, 0.0}, {-14.0, 5.0, 0.0}};
  scene.routes.drive = scene.routes.walk;
  return scene;
}

}  // namespace trajlo::simulation
