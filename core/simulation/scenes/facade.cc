// SPDX-License-Identifier: MIT
// One long facade of 160 x 18 m at the edge of an empty field: open to the other side.
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

}  // namespace trajlo::simulation
