// SPDX-License-Identifier: MIT
// A court of 60 x 40 m between facades, with trees, parked cars, lamps and uneven ground.
#include <cmath>

#include "core/simulation/scenes/scene_builder.h"
#include "core/simulation/scenes/scene_parts.h"

namespace trajlo::simulation {

SceneBlueprint BuildCourtyard(std::uint64_t seed) {
  CounterRandom random(seed, 0xc0047);
  SceneBlueprint scene;
  TriangleMesh& mesh = scene.mesh;
  const double phase = random.Uniform(0.0, 2.0 * M_PI);
  const auto ground = [phase](double x, double y) {
    return 0.05 * std::sin(0.3 * x + phase) * std::cos(0.25 * y) - 0.05;
  };
  mesh.AddHeightField({-45.0, -35.0}, {45.0, 35.0}, 2.0, ground, 0.3);
  AddFacade({-30.0, -20.0}, {30.0, -20.0}, -0.2, 12.0, &random, &mesh);
  AddFacade({30.0, -20.0}, {30.0, 20.0}, -0.2, 9.5, &random, &mesh);
  AddFacade({30.0, 20.0}, {-6.0, 20.0}, -0.2, 12.0, &random, &mesh);
  // A gateway, and a lower house behind it.
  AddFacade({-12.0, 20.0}, {-30.0, 20.0}, -0.2, 8.0, &random, &mesh);
  AddFacade({0.0, 33.0}, {-18.0, 33.0}, -0.2, 7.0, &random, &mesh);
  AddFacade({-30.0, 20.0}, {-30.0, -20.0}, -0.2, 11.0, &random, &mesh);

  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d base(-24.0 + 9.5 * i + random.Uniform(-1.0, 1.0),
                               random.Uniform(13.5, 15.5), -0.1);
    AddTree(base, random.Uniform(5.0, 8.0), &random, &mesh);
  }
  for (int i = 0; i < 3; ++i) {
    AddTree({random.Uniform(-3.0, 3.0) + 14.0 * (i - 1), random.Uniform(-2.0, 2.0), -0.1},
            random.Uniform(4.0, 6.0), &random, &mesh);
  }
  for (int i = 0; i < 8; ++i) {
    if (random.Uniform() < 0.2) continue;  // A free space.
    AddCar({-22.0 + 5.8 * i, -16.5 + random.Uniform(-0.2, 0.2), 0.0},
           M_PI / 2 + random.Uniform(-0.06, 0.06), &random, &mesh);
  }
  for (const double x : {-20.0, 0.0, 20.0}) AddLampPost({x, -12.5, -0.1}, M_PI / 2, 5.0, &mesh);
  for (const double x : {-15.0, 4.0, 17.0}) {
    mesh.AddBoxOnGround({x, 11.5, -0.1}, 0.0, {1.8, 0.5, 0.55}, 0.5);
  }
  mesh.AddBoxOnGround({8.0, -1.0, -0.1}, 0.4, {3.0, 3.0, 0.8}, 0.6);
  mesh.AddBoxOnGround({-25.5, 2.0, -0.1}, 0.0, {2.4, 6.0, 2.6}, 0.4);

  // A man and a woman cross the court, a delivery van circles in it.
  for (int i = 0; i < 3; ++i) {
    TriangleMesh person;
    AddPerson(Eigen::Vector3d::Zero(), 0.0, &random, &person);
    const double y = -10.0 + 4.0 * i;
    const double start = random.Uniform(0.0, 2.0 * M_PI);
    scene.moving_objects.push_back({person, [y, start](double t) {
                                      const double angle = 0.09 * t + start;
                                      const Eigen::Vector3d at(14.0 * std::sin(angle), y, -0.05);
                                      return SE3(Eigen::Quaterniond::Identity(), at);
                                    }});
  }

  scene.routes.ground_z_m = -0.05;
  scene.routes.fly.points = {{-18.0, -7.0, 4.0}, {-6.0, -8.0, 5.5}, {8.0, -8.0, 6.5},
                             {19.0, -7.0, 5.0},  {22.0, 0.0, 4.0},  {19.0, 7.5, 4.0},
                             {7.0, 8.5, 5.0},    {-7.0, 8.0, 7.0},  {-19.0, 7.5, 6.0},
                             {-22.0, 0.0, 4.5}};
  scene.routes.walk.points = {
      {-18.0, -8.0, -0.05}, {20.0, -8.0, -0.05}, {20.0, 8.0, -0.05}, {-18.0, 8.0, -0.05}};
  scene.routes.drive = scene.routes.walk;
  return scene;
}

}  // namespace trajlo::simulation
