// SPDX-License-Identifier: MIT
// An open square of 130 x 110 m: low houses far away, a monument, a few lamps and kiosks. What a
// horizontal LiDAR sees of it on taking off is mostly the ground.
#include <cmath>

#include "core/simulation/scenes/scene_builder.h"
#include "core/simulation/scenes/scene_parts.h"

namespace trajlo::simulation {

SceneBlueprint BuildSquare(std::uint64_t seed) {
  CounterRandom random(seed, 0x5904e);
  SceneBlueprint scene;
  TriangleMesh& mesh = scene.mesh;
  const double phase = random.Uniform(0.0, 2.0 * M_PI);
  mesh.AddHeightField(
      {-90.0, -80.0}, {90.0, 80.0}, 5.0,
      [phase](double x, double y) { return 0.06 * std::sin(0.12 * x + phase) * std::cos(0.1 * y); },
      0.35);
  AddFacade({-65.0, -55.0}, {65.0, -55.0}, -0.1, 9.5, &random, &mesh);
  AddFacade({65.0, -45.0}, {65.0, 45.0}, -0.1, 12.5, &random, &mesh);
  AddFacade({65.0, 55.0}, {5.0, 55.0}, -0.1, 9.5, &random, &mesh);
  AddFacade({-10.0, 55.0}, {-65.0, 55.0}, -0.1, 6.5, &random, &mesh);
  AddFacade({-65.0, 40.0}, {-65.0, -40.0}, -0.1, 9.5, &random, &mesh);
  // The monument stands on steps.
  for (int i = 0; i < 3; ++i) {
    const double size = 6.0 - 1.2 * i;
    mesh.AddBoxOnGround({18.0, 14.0, 0.35 * i - 0.1}, 0.3, {size, size, 0.45}, 0.6);
  }
  mesh.AddBoxOnGround({18.0, 14.0, 0.9}, 0.3, {1.6, 1.6, 3.0}, 0.6);
  mesh.AddCylinder({18.0, 14.0, 3.9}, {18.0, 14.0, 6.5}, 0.45, 0.5);
  for (const double x : {-40.0, -10.0, 20.0, 50.0}) {
    for (const double y : {-42.0, 42.0}) {
      AddLampPost({x + random.Uniform(-3.0, 3.0), y, -0.1}, y < 0 ? 1.57 : -1.57, 7.0, &mesh);
    }
  }
  for (int i = 0; i < 3; ++i) {
    mesh.AddBoxOnGround({random.Uniform(-50.0, 50.0), 33.0, -0.1}, random.Uniform(-0.5, 0.5),
                        {3.0, 2.4, 2.7}, 0.5);
  }
  for (int i = 0; i < 5; ++i) {
    AddTree({-48.0 + 22.0 * i + random.Uniform(-4.0, 4.0), -35.0, -0.1}, random.Uniform(5.0, 8.0),
            &random, &mesh);
  }
  scene.routes.ground_z_m = 0.0;
  scene.routes.fly.points = {{-12.0, -8.0, 8.0},  {2.0, -12.0, 10.0}, {24.0, -12.0, 12.0},
                             {36.0, 2.0, 11.0},   {28.0, 24.0, 9.0},  {4.0, 22.0, 12.0},
                             {-22.0, 18.0, 14.0}, {-26.0, 0.0, 10.0}};
  scene.routes.walk.points = {
      {-20.0, -15.0, 0.0}, {30.0, -15.0, 0.0}, {30.0, 25.0, 0.0}, {-20.0, 25.0, 0.0}};
  scene.routes.drive = scene.routes.walk;
  return scene;
}

}  // namespace trajlo::simulation
