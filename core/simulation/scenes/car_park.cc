// SPDX-License-Identifier: MIT
// One deck of a car park, 60 x 40 x 3 m: pillars, rows of cars, a ramp, and people who walk about.
#include <cmath>

#include "core/simulation/scenes/scene_builder.h"
#include "core/simulation/scenes/scene_parts.h"

namespace trajlo::simulation {

SceneBlueprint BuildCarPark(std::uint64_t seed) {
  CounterRandom random(seed, 0xca49a4c);
  SceneBlueprint scene;
  TriangleMesh& mesh = scene.mesh;
  AddPlate({-30.0, -20.0}, {30.0, 20.0}, 0.0, 0.3, &mesh);
  AddPlate({-30.0, -20.0}, {30.0, 20.0}, 3.2, 0.5, &mesh);
  AddPerimeter({-30.0, -20.0}, {30.0, 20.0}, 0.0, 3.2, 0.5, &mesh);
  for (const double x : EvenlySpaced(-25.0, 25.0, 10.0)) {
    mesh.AddBox({x - 0.15, -20.0, 2.8}, {x + 0.15, 20.0, 3.2}, 0.5);
    for (const double y : {-13.0, 0.0, 13.0}) {
      mesh.AddBox({x - 0.25, y - 0.25, 0.0}, {x + 0.25, y + 0.25, 2.8}, 0.6);
    }
  }
  // Rows along the walls and back to back in the middle; two lanes stay free.
  for (const double y : {-17.2, -2.7, 2.7, 17.2}) {
    for (const double x : EvenlySpaced(-27.0, 24.0, 2.6)) {
      const bool at_pillar = std::abs(std::remainder(x + 25.0, 10.0)) < 1.4;
      if (random.Uniform() > 0.6 || (std::abs(y) < 5.0 && at_pillar)) continue;
      AddCar({x, y + random.Uniform(-0.3, 0.3), 0.0}, M_PI / 2 + random.Uniform(-0.05, 0.05),
             &random, &mesh);
    }
  }
  mesh.AddBox({25.0, 16.0, 0.0}, {30.0, 20.0, 3.2}, 0.6);  // The stairs' shaft.
  mesh.AddCylinder({-30.0, -8.0, 2.6}, {30.0, -8.0, 2.6}, 0.1, 0.6, 10);
  for (int i = 0; i < 10; ++i) {
    TriangleMesh person;
    AddPerson(Eigen::Vector3d::Zero(), 0.0, &random, &person);
    const double lane = (i % 2 == 0 ? -9.5 : 9.5) + random.Uniform(-2.5, 2.5);
    const double reach = random.Uniform(8.0, 22.0);
    const double phase = random.Uniform(0.0, 2.0 * M_PI);
    const double rate = 1.3 / reach;  // About 1.3 m/s.
    scene.moving_objects.push_back({person, [=](double t) {
                                      const Eigen::Vector3d at(reach * std::sin(rate * t + phase),
                                                               lane, 0.0);
                                      return SE3(Eigen::Quaterniond::Identity(), at);
                                    }});
  }
  scene.routes.walk.points = {{-24.0, -8.8, 0.0},
                              {26.5, -8.8, 0.0},
                              {26.5, 8.8, 0.0},
                              {-28.5, 8.8, 0.0},
                              {-28.5, -8.8, 0.0}};
  scene.routes.drive = scene.routes.walk;
  scene.routes.fly = scene.routes.walk;
  for (Eigen::Vector3d& p : scene.routes.fly.points) p.z() = 1.6;
  return scene;
}

}  // namespace trajlo::simulation
