// SPDX-License-Identifier: MIT
// A wood of 90 x 90 m on rolling ground: trunks, crowns, bushes and fallen stems beside a path.
#include <cmath>
#include <functional>

#include "core/simulation/scenes/scene_builder.h"
#include "core/simulation/scenes/scene_parts.h"

namespace trajlo::simulation {

namespace {

/// The path is a ring of this radius about the origin.
constexpr double kPathRadius = 20.0;

/// Trees of the planted kind: a bare trunk, a crown of cones and spheres above eye level.
void AddForestTree(const Eigen::Vector3d& base, CounterRandom* random, TriangleMesh* mesh) {
  const double height = random->Uniform(9.0, 16.0);
  const Eigen::Vector3d top =
      base + Eigen::Vector3d(random->Uniform(-0.5, 0.5), random->Uniform(-0.5, 0.5), height);
  mesh->AddCylinder(base, top, random->Uniform(0.1, 0.28), 0.3, 10);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d at = base + (top - base) * (0.55 + 0.2 * i);
    mesh->AddSphere(at, random->Uniform(0.9, 1.6), 0.45, 5);
  }
  for (int i = 0; i < 3; ++i) {  // Dead branches.
    const double angle = random->Uniform(0.0, 2.0 * M_PI);
    const Eigen::Vector3d at = base + (top - base) * random->Uniform(0.15, 0.4);
    const double length = random->Uniform(0.4, 1.2);
    mesh->AddCylinder(at, at + length * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.3),
                      0.03, 0.3, 6);
  }
}

}  // namespace

SceneBlueprint BuildForest(std::uint64_t seed) {
  CounterRandom random(seed, 0xf04e57);
  SceneBlueprint scene;
  TriangleMesh& mesh = scene.mesh;
  const double phase = random.Uniform(0.0, 2.0 * M_PI);
  const std::function<double(double, double)> ground = [phase](double x, double y) {
    return 1.2 * std::sin(0.07 * x + phase) * std::cos(0.06 * y) + 0.12 * std::sin(0.9 * x) +
           0.1 * std::cos(0.8 * y + phase);
  };
  mesh.AddHeightField({-55.0, -55.0}, {55.0, 55.0}, 0.8, ground, 0.25);
  for (int i = 0; i < 420; ++i) {
    const double x = random.Uniform(-45.0, 45.0);
    const double y = random.Uniform(-45.0, 45.0);
    const double off_path = std::abs(std::hypot(x, y) - kPathRadius);
    const Eigen::Vector3d base(x, y, ground(x, y) - 0.1);
    if (off_path < 1.8) continue;
    if (random.Uniform() < 0.7) {
      AddForestTree(base, &random, &mesh);
    } else if (random.Uniform() < 0.8) {
      mesh.AddSphere(base + Eigen::Vector3d(0.0, 0.0, 0.3), random.Uniform(0.3, 0.8), 0.5, 5);
    } else {
      const double angle = random.Uniform(0.0, 2.0 * M_PI);
      const double length = random.Uniform(1.0, 1.6);
      const Eigen::Vector3d lying(length * std::cos(angle), length * std::sin(angle), 0.1);
      mesh.AddCylinder(base + Eigen::Vector3d(0.0, 0.0, 0.25) - lying,
                       base + Eigen::Vector3d(0.0, 0.0, 0.25) + lying, 0.18, 0.3, 10);
    }
  }
  for (int i = 0; i < 40; ++i) {
    const double angle = 2.0 * M_PI * i / 40.0;
    const double x = kPathRadius * std::sin(angle);
    const double y = -kPathRadius * std::cos(angle);
    scene.routes.walk.points.emplace_back(x, y, ground(x, y));
    scene.routes.fly.points.emplace_back(x, y, ground(x, y) + 3.0);
  }
  scene.routes.drive = scene.routes.walk;
  scene.routes.ground_z_m = ground(0.0, -kPathRadius);
  return scene;
}

}  // namespace trajlo::simulation
