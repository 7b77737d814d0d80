// SPDX-License-Identifier: MIT
// An office floor of 30 x 15 m: a corridor with five furnished rooms on either side.
#include "core/simulation/scenes/scene_builder.h"
#include "core/simulation/scenes/scene_parts.h"

namespace trajlo::simulation {

namespace {

constexpr double kCeiling = 2.8;
constexpr double kWall = 0.12;
constexpr double kRoom = 6.0;    // Along the corridor.
constexpr double kDepth = 7.5;   // From the corridor's axis to the outer wall.
constexpr double kAisle = 1.05;  // From its axis to its wall.

/// Furniture along the walls; the crossing ways through the middle of the room stay free.
void Furnish(double x, double side, CounterRandom* random, TriangleMesh* mesh) {
  for (const double offset : {-1.7, 1.7}) {
    const double turn = random->Uniform(-0.15, 0.15);
    AddTable({x + offset, side * 6.7, 0.0}, turn, {1.5, 0.75, 0.73}, mesh);
    AddChair({x + offset + random->Uniform(-0.2, 0.2), side * 6.0, 0.0}, random->Uniform(-1.0, 1.0),
             mesh);
    mesh->AddBoxOnGround({x + offset, side * 6.8, 0.8}, turn, {0.6, 0.05, 0.36}, 0.1);
  }
  if (random->Uniform() < 0.8) {
    AddShelf({x + 2.0, side * 1.4, 0.0}, side > 0.0 ? 0.0 : 3.14159,
             {1.5, 0.4, random->Uniform(1.2, 2.2)}, 5, mesh);
  }
  if (random->Uniform() < 0.7) {
    mesh->AddBoxOnGround({x - 2.2, side * 1.55, 0.0}, random->Uniform(-0.1, 0.1),
                         {0.8, 0.6, random->Uniform(0.6, 1.4)}, 0.5);
  }
  if (random->Uniform() < 0.6) {
    mesh->AddCylinder({x - 2.5, side * 6.9, 0.0}, {x - 2.5, side * 6.9, 0.4}, 0.22, 0.4, 14);
    mesh->AddSphere({x - 2.5, side * 6.9, 0.9}, 0.4, 0.4, 6);
  }
}

}  // namespace

SceneBlueprint BuildOffice(std::uint64_t seed) {
  CounterRandom random(seed, 0x0ff1ce);
  SceneBlueprint scene;
  TriangleMesh& mesh = scene.mesh;
  AddPlate({-15.0, -kDepth}, {15.0, kDepth}, 0.0, 0.3, &mesh);
  AddPlate({-15.0, -kDepth}, {15.0, kDepth}, kCeiling, 0.7, &mesh);
  std::vector<Opening> doors;
  std::vector<Opening> windows;
  for (int room = 0; room < 5; ++room) {
    const double middle = (room + 0.5) * kRoom;
    doors.push_back({middle - 0.5, middle + 0.5, 0.0, 2.1});
    windows.push_back({middle - 1.8, middle + 1.8, 0.9, 2.3});
  }
  for (const double side : {-1.0, 1.0}) {
    AddWall({-15.0, side * kAisle}, {15.0, side * kAisle}, 0.0, kCeiling, kWall, doors, 0.7, &mesh);
    AddWall({-15.0, side * kDepth}, {15.0, side * kDepth}, 0.0, kCeiling, 0.3, windows, 0.6, &mesh);
    mesh.AddQuad({-15.0, side * (kDepth + 0.1), 0.0}, {15.0, side * (kDepth + 0.1), 0.0},
                 {15.0, side * (kDepth + 0.1), kCeiling}, {-15.0, side * (kDepth + 0.1), kCeiling},
                 0.2);
    for (int room = 0; room < 5; ++room) {
      const double x = -15.0 + (room + 0.5) * kRoom;
      Furnish(x, side, &random, &mesh);
      if (room == 0) continue;
      // Two pairs of rooms are joined by a door.
      const bool joined = (side > 0.0 && room == 1) || (side < 0.0 && room == 3);
      const double way = (side > 0.0 ? 4.5 : 4.0) - kAisle;
      std::vector<Opening> gap;
      if (joined) gap.push_back({way - 0.5, way + 0.5, 0.0, 2.1});
      AddWall({x - 0.5 * kRoom, side * kAisle}, {x - 0.5 * kRoom, side * kDepth}, 0.0, kCeiling,
              kWall, gap, 0.7, &mesh);
    }
  }
  for (const double x : {-15.0, 15.0}) {
    AddWall({x, -kDepth}, {x, kDepth}, 0.0, kCeiling, 0.3, {{kDepth - 0.6, kDepth + 0.6, 0.8, 2.2}},
            0.6, &mesh);
    mesh.AddBox({x - 0.02, -0.7, 0.7}, {x + 0.02, 0.7, 2.3}, 0.2);
  }
  for (int i = 0; i < 6; ++i) {
    const double x = -12.5 + 5.0 * i;
    mesh.AddBox({x - 0.6, -0.15, kCeiling - 0.08}, {x + 0.6, 0.15, kCeiling}, 0.8);
  }
  AddShelf({-10.0, 0.85, 0.0}, 3.14159, {1.2, 0.3, 1.1}, 4, &mesh);
  mesh.AddBox({10.8, -0.98, 0.0}, {11.5, -0.55, 1.6}, 0.5);

  scene.routes.walk.points = {{-12.0, 4.5, 0.0}, {-6.0, 4.5, 0.0}, {-6.0, 0.0, 0.0},
                              {6.0, 0.0, 0.0},   {6.0, -4.0, 0.0}, {0.0, -4.0, 0.0},
                              {0.0, 0.0, 0.0},   {-12.0, 0.0, 0.0}};
  scene.routes.drive = scene.routes.walk;
  scene.routes.fly = scene.routes.walk;
  for (Eigen::Vector3d& p : scene.routes.fly.points) p.z() = 1.4;
  return scene;
}

}  // namespace trajlo::simulation
