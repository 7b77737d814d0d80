// SPDX-License-Identifier: MIT
// Facades at the edge of an empty field, open to the other side: one of 160 x 18 m, and a row of
// houses of 480 m.
#include <cmath>

#include "core/simulation/scenes/scene_builder.h"
#include "core/simulation/scenes/scene_parts.h"

namespace trajlo::simulation {

SceneBlueprint BuildFacade(std::uint64_t seed) {
  CounterRandom random(seed, 0xfacade);
  SceneBlueprint scene;
  TriangleMesh& mesh = scene.mesh;
  const double phase = random.Uniform(0.0, 2.0 * M_PI);
  mesh.AddHeightField(
      {-140.0, -110.0}, {140.0, 12.0}, 4.0,
      [phase](double x, double y) {
        return 0.12 * std::sin(0.08 * x + phase) * std::sin(0.09 * y);
      },
      0.3);
  AddFacade({80.0, 10.0}, {20.0, 10.0}, -0.2, 18.0, &random, &mesh);
  AddFacade({20.0, 10.4}, {-35.0, 10.4}, -0.2, 15.0, &random, &mesh);
  AddFacade({-35.0, 9.7}, {-80.0, 9.7}, -0.2, 18.0, &random, &mesh);
  for (const double x : {-60.0, -5.0, 48.0}) {
    mesh.AddBox({x - 2.0, 6.0, -0.2}, {x + 2.0, 10.0, 3.2}, 0.5);  // Porches.
  }
  for (int i = 0; i < 4; ++i) {
    AddTree({random.Uniform(-70.0, 70.0), random.Uniform(-60.0, -35.0), -0.2},
            random.Uniform(5.0, 9.0), &random, &mesh);
  }
  scene.routes.fly.closed = false;
  scene.routes.fly.points = {{-68.0, -4.0, 6.0},
                             {-30.0, -3.0, 9.0},
                             {10.0, -4.5, 12.0},
                             {45.0, -3.0, 8.0},
                             {68.0, -4.0, 6.0}};
  scene.routes.walk.points = {{-65.0, -6.0, 0.0}, {65.0, -6.0, 0.0}};
  scene.routes.walk.closed = false;
  scene.routes.drive = scene.routes.walk;
  return scene;
}

SceneBlueprint BuildLongFacade(std::uint64_t seed) {
  constexpr double kHalfLength = 240.0;
  CounterRandom random(seed, 0x10f4cade);
  SceneBlueprint scene;
  TriangleMesh& mesh = scene.mesh;
  const double phase = random.Uniform(0.0, 2.0 * M_PI);
  mesh.AddHeightField(
      {-kHalfLength - 80.0, -110.0}, {kHalfLength + 80.0, 14.0}, 4.0,
      [phase](double x, double y) {
        return 0.1 * (std::sin(0.07 * x + phase) * std::cos(0.1 * y) - 1.0);
      },
      0.3);
  double x = kHalfLength;
  while (x > -kHalfLength) {
    const double end = std::max(-kHalfLength, x - random.Uniform(35.0, 70.0));
    const double y = random.Uniform(9.5, 10.5);
    AddFacade({x, y}, {end, y}, -0.2, random.Uniform(13.0, 18.0), &random, &mesh);
    x = end;
  }
  for (int i = 0; i < 8; ++i) {
    const double porch = -210.0 + 60.0 * i + random.Uniform(-15.0, 15.0);
    mesh.AddBox({porch - 1.5, 7.0, -0.2}, {porch + 1.5, 10.5, 3.0}, 0.5);
    AddTree({random.Uniform(-220.0, 220.0), random.Uniform(-60.0, -30.0), -0.2},
            random.Uniform(5.0, 9.0), &random, &mesh);
  }
  scene.routes.fly.closed = false;
  scene.routes.fly.points = {{-225.0, -4.0, 6.0}, {-150.0, -2.0, 9.0}, {-70.0, -5.0, 6.5},
                             {20.0, -2.5, 11.0},  {110.0, -4.5, 8.0},  {225.0, -3.0, 10.0}};
  scene.routes.walk.points = {{-225.0, -6.0, 0.0}, {225.0, -6.0, 0.0}};
  scene.routes.walk.closed = false;
  scene.routes.drive = scene.routes.walk;
  return scene;
}

}  // namespace trajlo::simulation
