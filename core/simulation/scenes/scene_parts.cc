// SPDX-License-Identifier: MIT
#include "core/simulation/scenes/scene_parts.h"

#include <algorithm>
#include <cmath>

#include "manifolds/se3.h"

namespace trajlo::simulation {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

SE3 Standing(const Vector3d& base, double yaw_rad) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Vector3d::UnitZ())), base};
}

}  // namespace

std::vector<double> EvenlySpaced(double from, double to, double step) {
  std::vector<double> values(static_cast<std::size_t>((to - from) / step + 1e-9) + 1);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = from + static_cast<double>(i) * step;
  return values;
}

void AddWall(const Vector2d& from, const Vector2d& to, double z_m, double height_m,
             double thickness_m, const std::vector<Opening>& openings, double reflectivity,
             TriangleMesh* mesh) {
  const double length = (to - from).norm();
  const Vector2d along = (to - from) / length;
  const double yaw = std::atan2(along.y(), along.x());
  const auto add = [&](double a, double b, double bottom, double top) {
    if (b - a < 1e-6 || top - bottom < 1e-6) return;
    const Vector2d middle = from + along * 0.5 * (a + b);
    mesh->AddBoxOnGround({middle.x(), middle.y(), z_m + bottom}, yaw,
                         {b - a, thickness_m, top - bottom}, reflectivity);
  };
  double done = 0.0;
  for (const Opening& gap : openings) {
    add(done, gap.from_m, 0.0, height_m);
    add(gap.from_m, gap.to_m, 0.0, gap.bottom_m);
    add(gap.from_m, gap.to_m, gap.top_m, height_m);
    done = gap.to_m;
  }
  add(done, length, 0.0, height_m);
}

void AddPlate(const Vector2d& low, const Vector2d& high, double z_m, double reflectivity,
              TriangleMesh* mesh) {
  mesh->AddQuad({low.x(), low.y(), z_m}, {high.x(), low.y(), z_m}, {high.x(), high.y(), z_m},
                {low.x(), high.y(), z_m}, reflectivity);
}

void AddPerimeter(const Vector2d& low, const Vector2d& high, double z_m, double height_m,
                  double reflectivity, TriangleMesh* mesh) {
  const std::vector<Vector2d> corners = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2d& a = corners[i];
    const Vector2d& b = corners[(i + 1) % 4];
    mesh->AddQuad({a.x(), a.y(), z_m}, {b.x(), b.y(), z_m}, {b.x(), b.y(), z_m + height_m},
                  {a.x(), a.y(), z_m + height_m}, reflectivity);
  }
}

void AddFacade(const Vector2d& from, const Vector2d& to, double z_m, double height_m,
               CounterRandom* random, TriangleMesh* mesh) {
  constexpr double kStorey = 3.2;
  constexpr double kThickness = 0.3;
  const double length = (to - from).norm();
  const Vector2d along = (to - from) / length;
  const Vector2d left(-along.y(), along.x());
  const double pitch = random->Uniform(2.6, 4.0);
  const double window = random->Uniform(1.0, 1.6);
  const double reflectivity = random->Uniform(0.25, 0.7);
  const int storeys = std::max(1, static_cast<int>(height_m / kStorey));
  const int columns = static_cast<int>(length / pitch);
  const int door = static_cast<int>(random->Uniform() * columns);
  for (int storey = 0; storey < storeys; ++storey) {
    std::vector<Opening> openings;
    for (int column = 0; column < columns; ++column) {
      const double middle = (column + 0.5) * length / columns;
      const bool is_door = storey == 0 && column == door;
      openings.push_back(
          {middle - 0.5 * window, middle + 0.5 * window, is_door ? 0.0 : 0.9, is_door ? 2.2 : 2.4});
    }
    const double bottom = z_m + storey * kStorey;
    const double top = storey + 1 == storeys ? z_m + height_m : bottom + kStorey;
    AddWall(from, to, bottom, top - bottom, kThickness, openings, reflectivity, mesh);
  }
  // Behind the openings: panes, set back.
  const Vector2d back = -0.3 * kThickness * left;
  const Vector2d a = from + back;
  const Vector2d b = to + back;
  mesh->AddQuad({a.x(), a.y(), z_m}, {b.x(), b.y(), z_m}, {b.x(), b.y(), z_m + height_m},
                {a.x(), a.y(), z_m + height_m}, 0.15);
  // A cornice at the top.
  const Vector2d middle = 0.5 * (from + to);
  mesh->AddBoxOnGround({middle.x(), middle.y(), z_m + height_m}, std::atan2(along.y(), along.x()),
                       {length, kThickness + 0.5, 0.3}, reflectivity);
}

void AddTree(const Vector3d& base, double height_m, CounterRandom* random, TriangleMesh* mesh) {
  const double crown = height_m * random->Uniform(0.2, 0.28);
  const double trunk = height_m - 2.2 * crown;
  const double radius = 0.02 * height_m + random->Uniform(0.03, 0.1);
  const Vector3d lean(random->Uniform(-0.04, 0.04) * trunk, random->Uniform(-0.04, 0.04) * trunk,
                      trunk + crown);
  mesh->AddCylinder(base, base + lean, radius, 0.3, 12);
  for (int i = 0; i < 4; ++i) {
    const Vector3d offset(random->Uniform(-0.5, 0.5) * crown, random->Uniform(-0.5, 0.5) * crown,
                          random->Uniform(-0.2, 0.6) * crown);
    mesh->AddSphere(base + lean + offset, crown * random->Uniform(0.55, 0.8), 0.45, 6);
  }
}

void AddCar(const Vector3d& base, double yaw_rad, CounterRandom* random, TriangleMesh* mesh) {
  const double length = random->Uniform(3.9, 4.8);
  const double width = random->Uniform(1.7, 1.9);
  const double height = random->Uniform(1.4, 1.75);
  const double paint = random->Uniform(0.15, 0.8);
  TriangleMesh car;
  car.AddBoxOnGround({0.0, 0.0, 0.25}, 0.0, {length, width, 0.55 * height}, paint);
  car.AddBoxOnGround({-0.05 * length, 0.0, 0.25 + 0.55 * height}, 0.0,
                     {0.5 * length, 0.88 * width, 0.45 * height - 0.25}, 0.5 * paint);
  for (const double x : {-0.3 * length, 0.3 * length}) {
    for (const double side : {-0.5, 0.5}) {
      const double y = side * (width - 0.2);
      car.AddCylinder({x, y - 0.1, 0.32}, {x, y + 0.1, 0.32}, 0.32, 0.1, 12);
    }
  }
  mesh->AddMesh(car, Standing(base, yaw_rad));
}

void AddPerson(const Vector3d& base, double yaw_rad, CounterRandom* random, TriangleMesh* mesh) {
  const double height = random->Uniform(1.6, 1.9);
  TriangleMesh person;
  for (const double y : {-0.1, 0.1}) {
    person.AddCylinder({0.0, y, 0.0}, {0.0, y, 0.48 * height}, 0.08, 0.3, 8);
  }
  person.AddBoxOnGround({0.0, 0.0, 0.48 * height}, 0.0, {0.24, 0.42, 0.36 * height}, 0.5);
  person.AddSphere({0.0, 0.0, 0.93 * height}, 0.11, 0.4, 6);
  mesh->AddMesh(person, Standing(base, yaw_rad));
}

void AddTable(const Vector3d& base, double yaw_rad, const Vector3d& size, TriangleMesh* mesh) {
  TriangleMesh table;
  table.AddBoxOnGround({0.0, 0.0, size.z() - 0.04}, 0.0, {size.x(), size.y(), 0.04}, 0.6);
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      table.AddBoxOnGround({x * (size.x() - 0.08), y * (size.y() - 0.08), 0.0}, 0.0,
                           {0.06, 0.06, size.z() - 0.04}, 0.4);
    }
  }
  mesh->AddMesh(table, Standing(base, yaw_rad));
}

void AddChair(const Vector3d& base, double yaw_rad, TriangleMesh* mesh) {
  TriangleMesh chair;
  chair.AddCylinder({0.0, 0.0, 0.0}, {0.0, 0.0, 0.44}, 0.04, 0.3, 8);
  chair.AddCylinder({0.0, 0.0, 0.0}, {0.0, 0.0, 0.06}, 0.28, 0.2, 10);
  chair.AddBoxOnGround({0.0, 0.0, 0.44}, 0.0, {0.46, 0.46, 0.07}, 0.3);
  chair.AddBoxOnGround({-0.22, 0.0, 0.51}, 0.0, {0.06, 0.44, 0.45}, 0.3);
  mesh->AddMesh(chair, Standing(base, yaw_rad));
}

void AddShelf(const Vector3d& base, double yaw_rad, const Vector3d& size, int boards,
              TriangleMesh* mesh) {
  constexpr double kBoard = 0.03;
  TriangleMesh shelf;
  for (const double x : {-0.5, 0.5}) {
    shelf.AddBoxOnGround({x * (size.x() - kBoard), 0.0, 0.0}, 0.0, {kBoard, size.y(), size.z()},
                         0.5);
  }
  shelf.AddBoxOnGround({0.0, -0.5 * (size.y() - kBoard), 0.0}, 0.0, {size.x(), kBoard, size.z()},
                       0.5);
  for (int i = 0; i < boards; ++i) {
    const double z = (size.z() - kBoard) * i / std::max(1, boards - 1);
    shelf.AddBoxOnGround({0.0, 0.0, z}, 0.0, {size.x(), size.y(), kBoard}, 0.5);
  }
  mesh->AddMesh(shelf, Standing(base, yaw_rad));
}

void AddLampPost(const Vector3d& base, double yaw_rad, double height_m, TriangleMesh* mesh) {
  TriangleMesh lamp;
  lamp.AddCylinder({0.0, 0.0, 0.0}, {0.0, 0.0, height_m}, 0.08, 0.4, 10);
  lamp.AddCylinder({0.0, 0.0, height_m}, {1.2, 0.0, height_m + 0.2}, 0.05, 0.4, 8);
  lamp.AddBoxOnGround({1.4, 0.0, height_m + 0.15}, 0.0, {0.6, 0.25, 0.12}, 0.6);
  mesh->AddMesh(lamp, Standing(base, yaw_rad));
}

void AddMachine(const Vector3d& base, double yaw_rad, CounterRandom* random, TriangleMesh* mesh) {
  const Vector3d size(random->Uniform(1.5, 3.0), random->Uniform(1.0, 2.0),
                      random->Uniform(0.9, 1.6));
  TriangleMesh machine;
  machine.AddBoxOnGround({0.0, 0.0, 0.0}, 0.0, size, 0.5);
  machine.AddBoxOnGround({0.3 * size.x(), 0.0, size.z()}, 0.0,
                         {0.3 * size.x(), 0.8 * size.y(), random->Uniform(0.5, 1.2)}, 0.35);
  const double radius = 0.25 * size.y();
  machine.AddCylinder({-0.25 * size.x(), 0.0, size.z()},
                      {-0.25 * size.x(), 0.0, size.z() + random->Uniform(0.5, 1.5)}, radius, 0.6,
                      20);
  mesh->AddMesh(machine, Standing(base, yaw_rad));
}

}  // namespace trajlo::simulation
