// SPDX-License-Identifier: MIT
// The skeleton of a building of 36 x 24 m: slabs, columns, half-built walls, scaffolding, material.
#include "core/simulation/scenes/scene_builder.h"
#include "core/simulation/scenes/scene_parts.h"

namespace trajlo::simulation {

namespace {

/// Standards, ledgers and boards along one side.
void AddScaffold(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double height_m,
                 TriangleMesh* mesh) {
  const double length = (to - from).norm();
  const Eigen::Vector2d along = (to - from) / length;
  const Eigen::Vector2d across(-along.y(), along.x());
  const int bays = static_cast<int>(length / 2.5);
  const auto at = [&](double s, double side, double z) -> Eigen::Vector3d {
    const Eigen::Vector2d p = from + s * along + side * across;
    return {p.x(), p.y(), z};
  };
  for (const double side : {0.0, 1.0}) {
    for (int i = 0; i <= bays; ++i) {
      const double s = length * i / bays;
      mesh->AddCylinder(at(s, side, 0.0), at(s, side, height_m), 0.025, 0.6, 8);
    }
    for (const double z : EvenlySpaced(2.0, height_m, 2.0)) {
      mesh->AddCylinder(at(0.0, side, z), at(length, side, z), 0.025, 0.6, 8);
    }
  }
  for (const double z : EvenlySpaced(2.0, height_m, 2.0)) {
    const Eigen::Vector3d middle = at(0.5 * length, 0.5, z);
    mesh->AddBoxOnGround(middle, std::atan2(along.y(), along.x()), {length, 0.9, 0.05}, 0.4);
  }
}

}  // namespace

SceneBlueprint BuildConstructionSite(std::uint64_t seed) {
  constexpr double kStorey = 3.6;
  CounterRandom random(seed, 0xc0457);
  SceneBlueprint scene;
  TriangleMesh& mesh = scene.mesh;
  const double phase = random.Uniform(0.0, 6.0);
  mesh.AddHeightField(
      {-60.0, -50.0}, {60.0, 50.0}, 3.0,
      [phase](double x, double y) {
        const bool under_the_building = std::abs(x) < 21.0 && std::abs(y) < 15.0;
        return under_the_building ? -0.05 : 0.25 * std::sin(0.2 * x + phase) * std::sin(0.23 * y);
      },
      0.25);
  mesh.AddBox({-18.0, -12.0, -0.3}, {18.0, 12.0, 0.0}, 0.4);
  for (int storey = 1; storey <= 3; ++storey) {
    const double z = storey * kStorey;
    // The upper slabs end earlier, and all leave a shaft open.
    const double end = storey == 3 ? 6.0 : 18.0;
    mesh.AddBox({-18.0, -12.0, z - 0.3}, {end, 4.0, z}, 0.4);
    mesh.AddBox({-18.0, 4.0, z - 0.3}, {0.0, 12.0, z}, 0.4);
    mesh.AddBox({5.0, 4.0, z - 0.3}, {std::max(5.1, end), 12.0, z}, 0.4);
    for (const double x : EvenlySpaced(-17.5, end, 7.0)) {
      for (const double y : {-11.5, -4.0, 4.0, 11.5}) {
        mesh.AddBox({x - 0.2, y - 0.2, z - kStorey}, {x + 0.2, y + 0.2, z - 0.3}, 0.45);
      }
    }
  }
  AddWall({-18.0, 12.0}, {4.0, 12.0}, 0.0, kStorey - 0.3, 0.24,
          {{3.0, 5.0, 0.9, 2.3}, {9.0, 10.2, 0.0, 2.2}, {15.0, 17.0, 0.9, 2.3}}, 0.5, &mesh);
  AddWall({-11.0, -4.0}, {-11.0, 4.0}, 0.0, 2.0, 0.24, {}, 0.5, &mesh);
  AddWall({3.5, -12.0}, {3.5, -4.5}, 0.0, kStorey - 0.3, 0.24, {}, 0.5, &mesh);
  AddScaffold({-18.0, 12.8}, {18.0, 12.8}, 11.0, &mesh);
  AddScaffold({18.8, 12.0}, {18.8, -12.0}, 9.0, &mesh);
  for (int i = 0; i < 9; ++i) {
    const Eigen::Vector3d size(random.Uniform(0.8, 1.4), random.Uniform(0.8, 1.2),
                               random.Uniform(0.5, 1.4));
    mesh.AddBoxOnGround({-16.0 + 4.0 * i, random.Uniform(-10.8, -9.6), 0.0},
                        random.Uniform(-0.4, 0.4), size, 0.5);
  }
  for (int i = 0; i < 5; ++i) {  // Props and rods.
    const double x = random.Uniform(6.0, 13.0);
    mesh.AddCylinder({x, 1.0 + i * 0.6, 0.0}, {x, 1.0 + i * 0.6, kStorey - 0.3}, 0.05, 0.5, 8);
  }
  mesh.AddBoxOnGround({28.0, -20.0, 0.0}, 0.2, {6.0, 2.5, 2.6}, 0.5);
  mesh.AddBoxOnGround({-29.0, 8.0, 0.0}, 1.4, {6.0, 2.5, 5.2}, 0.5);
  mesh.AddCylinder({27.0, 20.0, 0.0}, {27.0, 20.0, 22.0}, 0.7, 0.6, 8);  // The crane.
  mesh.AddCylinder({10.0, 16.0, 22.0}, {50.0, 26.0, 22.0}, 0.5, 0.6, 8);

  scene.routes.walk.points = {{-14.5, -7.0, 0.0}, {0.5, -7.0, 0.0}, {0.5, 0.0, 0.0},
                              {15.0, -1.0, 0.0},  {15.0, 7.5, 0.0}, {-3.0, 7.5, 0.0},
                              {-14.5, 7.5, 0.0},  {-14.5, 0.0, 0.0}};
  scene.routes.drive = scene.routes.walk;
  scene.routes.fly.points = {{-26.0, -18.0, 5.0}, {0.0, -19.0, 7.0},  {22.0, -21.0, 9.0},
                             {33.0, -4.0, 8.0},   {33.0, 10.0, 10.0}, {12.0, 22.0, 14.0},
                             {-24.0, 20.0, 12.0}, {-36.0, 0.0, 8.0}};
  return scene;
}

}  // namespace trajlo::simulation
