// SPDX-License-Identifier: MIT
// 2.4 km of a straight motorway between fields: guard rails, posts, a few signs, bridges and trees.
#include <cmath>

#include "core/simulation/scenes/scene_builder.h"
#include "core/simulation/scenes/scene_parts.h"

namespace trajlo::simulation {

SceneBlueprint BuildMotorway(std::uint64_t seed) {
  constexpr double kHalfLength = 1200.0;
  CounterRandom random(seed, 0x3070);
  SceneBlueprint scene;
  TriangleMesh& mesh = scene.mesh;
  const double phase = random.Uniform(0.0, 2.0 * M_PI);
  // Cuttings and embankments beside a flat road.
  mesh.AddHeightField(
      {-kHalfLength - 150.0, -100.0}, {kHalfLength + 150.0, 100.0}, 8.0,
      [phase](double x, double y) {
        const double side = std::max(0.0, std::abs(y) - 18.0);
        return (1.0 - std::exp(-side / 15.0)) * 3.0 * std::sin(0.011 * x + phase);
      },
      0.25);
  for (const double y : {-15.0, -1.0, 1.0, 15.0}) {
    mesh.AddBox({-kHalfLength - 100.0, y - 0.04, 0.45}, {kHalfLength + 100.0, y + 0.04, 0.75}, 0.7);
    for (const double x : EvenlySpaced(-kHalfLength, kHalfLength, 4.0)) {
      mesh.AddBox({x - 0.06, y - 0.05, 0.0}, {x + 0.06, y + 0.05, 0.7}, 0.6);
    }
  }
  double sign_x = -kHalfLength + 60.0;
  while (sign_x < kHalfLength) {
    const double side = random.Uniform() < 0.5 ? -17.0 : 17.0;
    mesh.AddCylinder({sign_x, side, 0.0}, {sign_x, side, 3.5}, 0.06, 0.6, 8);
    mesh.AddBoxOnGround({sign_x, side, 2.2}, 0.0, {0.05, 2.2, 1.6}, 0.9);
    sign_x += random.Uniform(120.0, 260.0);
  }
  for (const double bridge : {-620.0, 90.0, 780.0}) {
    const double at = bridge + random.Uniform(-40.0, 40.0);
    mesh.AddBox({at - 4.0, -40.0, 5.6}, {at + 4.0, 40.0, 6.8}, 0.5);
    for (const double y : {-17.5, 17.5})
      mesh.AddBox({at - 3.5, y - 0.6, 0.0}, {at + 3.5, y + 0.6, 5.6}, 0.5);
  }
  for (int i = 0; i < 160; ++i) {
    const double side = random.Uniform() < 0.5 ? -1.0 : 1.0;
    AddTree({random.Uniform(-kHalfLength, kHalfLength), side * random.Uniform(24.0, 70.0), -1.5},
            random.Uniform(5.0, 9.0), &random, &mesh);
  }
  for (int i = 0; i < 8; ++i) {
    TriangleMesh car;
    AddCar(Eigen::Vector3d::Zero(), 0.0, &random, &car);
    const double start = -kHalfLength + 40.0 + 60.0 * i;
    const double lane = i % 2 == 0 ? -4.0 : -11.5;
    const double speed = random.Uniform(22.0, 36.0);
    scene.moving_objects.push_back({car, [start, lane, speed](double t) {
                                      const Eigen::Vector3d at(start + speed * t, lane, 0.0);
                                      return SE3(Eigen::Quaterniond::Identity(), at);
                                    }});
  }
  scene.routes.drive.closed = false;
  scene.routes.drive.points = {{-kHalfLength + 20.0, -8.0, 0.0}, {kHalfLength - 20.0, -8.0, 0.0}};
  scene.routes.walk = scene.routes.drive;
  scene.routes.fly = scene.routes.drive;
  for (Eigen::Vector3d& p : scene.routes.fly.points) p.z() = 12.0;
  return scene;
}

}  // namespace trajlo::simulation
