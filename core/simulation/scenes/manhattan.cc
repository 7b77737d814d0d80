// SPDX-License-Identifier: MIT
// A grid of streets between plain boxes: walls in two directions only, hardly a pole or a tree.
#include "core/simulation/scenes/scene_builder.h"
#include "core/simulation/scenes/scene_parts.h"

namespace trajlo::simulation {

SceneBlueprint BuildManhattan(std::uint64_t seed) {
  constexpr double kPitchX = 90.0;
  constexpr double kPitchY = 70.0;
  constexpr double kHalfStreet = 9.0;
  CounterRandom random(seed, 0x3a4a77a4);
  SceneBlueprint scene;
  TriangleMesh& mesh = scene.mesh;
  AddPlate({-300.0, -250.0}, {300.0, 250.0}, 0.0, 0.25, &mesh);
  for (int ix = -2; ix <= 2; ++ix) {
    for (int iy = -2; iy <= 2; ++iy) {
      const double x = ix * kPitchX;
      const double y = iy * kPitchY;
      const double dx = 0.5 * kPitchX - kHalfStreet;
      const double dy = 0.5 * kPitchY - kHalfStreet;
      // Two or three houses share a block; they differ in height and by a step in the front.
      const double cut = random.Uniform(-0.4, 0.4) * dx;
      const double step = random.Uniform(0.2, 0.8);
      mesh.AddBox({x - dx, y - dy, 0.0}, {x + cut, y + dy, random.Uniform(15.0, 45.0)},
                  random.Uniform(0.3, 0.6));
      mesh.AddBox({x + cut, y - dy + step, 0.0},
                  {x + dx - step, y + dy - step, random.Uniform(15.0, 45.0)},
                  random.Uniform(0.3, 0.6));
      // The pavement.
      mesh.AddBox({x - dx - 3.0, y - dy - 3.0, 0.0}, {x + dx + 3.0, y + dy + 3.0, 0.15}, 0.35);
      if (random.Uniform() < 0.5) {
        mesh.AddBox({x + dx + 0.5, y - 4.0, 0.15}, {x + dx + 1.6, y + 1.0, 2.6}, 0.5);
      }
    }
  }
  const double x = 0.5 * kPitchX;
  const double y = 0.5 * kPitchY;
  scene.routes.drive.points = {{-20.0, -y - 3.0, 0.0},
                               {x + 3.0, -y - 3.0, 0.0},
                               {x + 3.0, y + 3.0, 0.0},
                               {-x - 3.0, y + 3.0, 0.0},
                               {-x - 3.0, -y - 3.0, 0.0}};
  for (int i = 0; i < 3; ++i) {
    TriangleMesh car;
    AddCar(Eigen::Vector3d::Zero(), 0.0, &random, &car);
    const double phase = random.Uniform(0.0, 6.0);
    const double lane = i % 2 == 0 ? -y + 3.0 : y - 3.0;
    scene.moving_objects.push_back({car, [phase, lane](double t) {
                                      const Eigen::Vector3d at(80.0 * std::sin(0.1 * t + phase),
                                                               lane, 0.0);
                                      return SE3(Eigen::Quaterniond::Identity(), at);
                                    }});
  }
  scene.routes.walk = scene.routes.drive;
  scene.routes.fly = scene.routes.drive;
  for (Eigen::Vector3d& p : scene.routes.fly.points) p.z() = 12.0;
  return scene;
}

}  // namespace trajlo::simulation
