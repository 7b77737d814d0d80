// SPDX-License-Identifier: MIT
// Streets around a city block of 220 x 110 m: facades, parked cars, trees, lamps, side streets.
#include <cmath>

#include "core/simulation/scenes/scene_builder.h"
#include "core/simulation/scenes/scene_parts.h"

namespace trajlo::simulation {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Houses of different heights along one side of a street, with a gap now and then. They face to
/// the left of the way from `from` to `to`.
void AddHouses(const Vector2d& from, const Vector2d& to, CounterRandom* random,
               TriangleMesh* mesh) {
  const double length = (to - from).norm();
  const Vector2d along = (to - from) / length;
  const Vector2d left(-along.y(), along.x());
  double at = 0.0;
  while (at < length - 8.0) {
    const double width = std::min(random->Uniform(12.0, 26.0), length - at);
    const Vector2d setback = -random->Uniform(0.0, 1.2) * left;
    AddFacade(from + at * along + setback, from + (at + width) * along + setback, 0.0,
              random->Uniform(7.0, 18.0), random, mesh);
    // The sides of a house show where the next one stands back or there is a gap.
    for (const double end : {at, at + width}) {
      const Vector2d a = from + end * along + setback;
      const Vector2d b = a - 10.0 * left;
      mesh->AddQuad({a.x(), a.y(), 0.0}, {b.x(), b.y(), 0.0}, {b.x(), b.y(), 7.0},
                    {a.x(), a.y(), 7.0}, 0.4);
    }
    at += width + (random->Uniform() < 0.25 ? random->Uniform(3.0, 8.0) : 0.0);
  }
}

/// What stands on the pavement: parked cars, trees and lamps, to the left of the way.
void AddRoadside(const Vector2d& from, const Vector2d& to, CounterRandom* random,
                 TriangleMesh* mesh) {
  const double length = (to - from).norm();
  const Vector2d along = (to - from) / length;
  const Vector2d left(-along.y(), along.x());
  const double yaw = std::atan2(along.y(), along.x());
  const auto at = [&](double s, double side) -> Vector3d {
    const Vector2d p = from + s * along + side * left;
    return {p.x(), p.y(), 0.0};
  };
  // A kerb of 12 cm.
  mesh->AddBoxOnGround(at(0.5 * length, 1.5), yaw, {length, 3.0, 0.12}, 0.4);
  double s = 5.0;
  while (s < length - 5.0) {
    if (random->Uniform() < 0.65) {
      AddCar(at(s, -1.1), yaw + random->Uniform(-0.03, 0.03), random, mesh);
    }
    s += random->Uniform(5.5, 9.0);
  }
  s = 8.0;
  while (s < length - 5.0) {
    if (random->Uniform() < 0.6) {
      AddTree(at(s, 0.8), random->Uniform(5.0, 8.0), random, mesh);
    } else {
      AddLampPost(at(s, 0.4), yaw - M_PI / 2, 6.5, mesh);
    }
    if (random->Uniform() < 0.4) {
      mesh->AddBoxOnGround(at(s + 3.0, 2.0), yaw, {0.7, 0.6, 1.1}, 0.4);
    }
    s += random->Uniform(14.0, 20.0);
  }
}

std::vector<Vector2d> Corners(double half_x, double half_y) {
  return {{-half_x, -half_y}, {half_x, -half_y}, {half_x, half_y}, {-half_x, half_y}};
}

}  // namespace

SceneBlueprint BuildStreet(std::uint64_t seed) {
  CounterRandom random(seed, 0x57437);
  SceneBlueprint scene;
  TriangleMesh& mesh = scene.mesh;
  // The crown of the road and the drains: a few centimetres.
  mesh.AddHeightField(
      {-160.0, -110.0}, {160.0, 110.0}, 4.0,
      [](double x, double y) { return 0.03 * std::sin(0.11 * x) * std::sin(0.13 * y); }, 0.2);
  const std::vector<Vector2d> inner = Corners(101.0, 46.0);
  const std::vector<Vector2d> inner_kerb = Corners(104.0, 49.0);
  const std::vector<Vector2d> outer = Corners(121.0, 66.0);
  const std::vector<Vector2d> outer_kerb = Corners(118.0, 63.0);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    AddHouses(inner[next], inner[i], &random, &mesh);  // The block faces outwards ...
    AddRoadside(inner_kerb[i], inner_kerb[next], &random, &mesh);
    AddHouses(outer[i], outer[next], &random, &mesh);  // ... and the other side inwards.
    AddRoadside(outer_kerb[next], outer_kerb[i], &random, &mesh);
  }
  for (int i = 0; i < 4; ++i) {
    TriangleMesh car;
    AddCar(Vector3d::Zero(), 0.0, &random, &car);
    const double start = random.Uniform(-90.0, 90.0);
    const double y = i % 2 == 0 ? -58.0 : 58.0;
    // Oncoming traffic on the two long sides, to and fro beyond the corners.
    scene.moving_objects.push_back({car, [start, y](double t) {
                                      const double x = 85.0 * std::sin(0.1 * t + start / 60.0);
                                      return SE3(Eigen::Quaterniond::Identity(), {x, y, 0.0});
                                    }});
  }
  scene.routes.drive.points = {{25.0, -54.5, 0.0},
                               {109.5, -54.5, 0.0},
                               {109.5, 54.5, 0.0},
                               {-109.5, 54.5, 0.0},
                               {-109.5, -54.5, 0.0}};
  scene.routes.walk = scene.routes.drive;
  scene.routes.fly = scene.routes.drive;
  for (Vector3d& p : scene.routes.fly.points) p.z() = 6.0;
  return scene;
}

}  // namespace trajlo::simulation
