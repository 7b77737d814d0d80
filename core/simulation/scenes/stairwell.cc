// SPDX-License-Identifier: MIT
// A stairwell of four storeys: two flights and two landings each, in a shaft of 2.8 x 6.4 m.
#include "core/simulation/scenes/scene_builder.h"
#include "core/simulation/scenes/scene_parts.h"

namespace trajlo::simulation {

SceneBlueprint BuildStairwell(std::uint64_t seed) {
  constexpr int kStoreys = 4;
  constexpr int kSteps = 10;  // In a flight.
  constexpr double kRise = 0.17;
  constexpr double kTread = 0.29;
  constexpr double kHalfFlight = 0.5 * kSteps * kTread;
  constexpr double kLanding = 1.75;
  constexpr double kEnd = kHalfFlight + kLanding;
  CounterRandom random(seed, 0x57a14);
  SceneBlueprint scene;
  TriangleMesh& mesh = scene.mesh;
  const double storey = 2.0 * kSteps * kRise;
  const double height = kStoreys * storey + 2.6;
  AddPlate({-kEnd, -1.4}, {kEnd, 1.4}, 0.0, 0.4, &mesh);
  AddPlate({-kEnd, -1.4}, {kEnd, 1.4}, height, 0.7, &mesh);
  AddPerimeter({-kEnd, -1.4}, {kEnd, 1.4}, 0.0, height, 0.65, &mesh);
  Route& walk = scene.routes.walk;
  walk.closed = false;
  for (int i = 0; i < kStoreys; ++i) {
    const double z = i * storey;
    for (int step = 0; step < kSteps; ++step) {
      const double x = -kHalfFlight + step * kTread;
      const double top = z + (step + 1) * kRise;
      mesh.AddBox({x, -1.4, top - 0.25}, {x + kTread, -0.1, top}, 0.4);
      const double upper = top + kSteps * kRise;
      mesh.AddBox({-x - kTread, 0.1, upper - 0.25}, {-x, 1.4, upper}, 0.4);
    }
    const double middle = z + kSteps * kRise;
    mesh.AddBox({kHalfFlight, -1.4, middle - 0.2}, {kEnd, 1.4, middle}, 0.4);
    mesh.AddBox({-kEnd, -1.4, z + storey - 0.2}, {-kHalfFlight, 1.4, z + storey}, 0.4);
    // A door at each storey, a window at each half landing, and the rails between the flights.
    mesh.AddBox({-kEnd - 0.02, -0.5, z}, {-kEnd + 0.06, 0.5, z + 2.1}, 0.3);
    mesh.AddBox({kEnd - 0.08, -0.6, middle + 1.0}, {kEnd, 0.6, middle + 2.0}, 0.15);
    const double low = z + 0.95;
    mesh.AddCylinder({-kHalfFlight, -0.05, low}, {kHalfFlight, -0.05, low + kSteps * kRise}, 0.025,
                     0.6, 8);
    mesh.AddCylinder({kHalfFlight, 0.05, low + kSteps * kRise}, {-kHalfFlight, 0.05, low + storey},
                     0.025, 0.6, 8);
    mesh.AddBox({random.Uniform(2.0, 2.6), 1.2, middle}, {2.9, 1.4, middle + 0.7}, 0.5);

    walk.points.insert(walk.points.end(), {{-kHalfFlight - 0.7, -0.75, z},
                                           {-kHalfFlight, -0.75, z},
                                           {kHalfFlight, -0.75, middle},
                                           {kHalfFlight + 0.7, -0.75, middle},
                                           {kHalfFlight + 0.7, 0.75, middle},
                                           {kHalfFlight, 0.75, middle},
                                           {-kHalfFlight, 0.75, z + storey},
                                           {-kHalfFlight - 0.7, 0.75, z + storey}});
  }
  scene.routes.drive = walk;
  scene.routes.fly = walk;
  for (Eigen::Vector3d& p : scene.routes.fly.points) p.z() += 1.3;
  return scene;
}

}  // namespace trajlo::simulation
