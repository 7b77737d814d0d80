// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/simulation/random/counter_random.h"
#include "core/simulation/scenes/triangle_mesh.h"

/// Furniture, trees, cars: the things that scenes are filled with. All stand on `base` (x, y and
/// the height of the ground), metres.
namespace trajlo::simulation {

/// from, from + step, ... up to and including `to`.
std::vector<double> EvenlySpaced(double from, double to, double step);

/// A rectangular gap in a wall, along it from its start and upwards from its foot.
struct Opening {
  double from_m, to_m, bottom_m, top_m;
};

/// A straight wall with thickness and openings, which must be in order and not overlap.
void AddWall(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double z_m, double height_m,
             double thickness_m, const std::vector<Opening>& openings, double reflectivity,
             TriangleMesh* mesh);
/// Floor or ceiling: a horizontal rectangle.
void AddPlate(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double z_m,
              double reflectivity, TriangleMesh* mesh);
/// The four walls of a rectangle, as single faces.
void AddPerimeter(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double z_m,
                  double height_m, double reflectivity, TriangleMesh* mesh);
/// The face of a building with rows of recessed windows and a door; it faces to the left of the way
/// from `from` to `to`.
void AddFacade(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double z_m, double height_m,
               CounterRandom* random, TriangleMesh* mesh);

void AddTree(const Eigen::Vector3d& base, double height_m, CounterRandom* random,
             TriangleMesh* mesh);
void AddCar(const Eigen::Vector3d& base, double yaw_rad, CounterRandom* random, TriangleMesh* mesh);
void AddPerson(const Eigen::Vector3d& base, double yaw_rad, CounterRandom* random,
               TriangleMesh* mesh);
void AddTable(const Eigen::Vector3d& base, double yaw_rad, const Eigen::Vector3d& size,
              TriangleMesh* mesh);
void AddChair(const Eigen::Vector3d& base, double yaw_rad, TriangleMesh* mesh);
void AddShelf(const Eigen::Vector3d& base, double yaw_rad, const Eigen::Vector3d& size, int boards,
              TriangleMesh* mesh);
void AddLampPost(const Eigen::Vector3d& base, double yaw_rad, double height_m, TriangleMesh* mesh);
/// A machine of a workshop: a few boxes and cylinders.
void AddMachine(const Eigen::Vector3d& base, double yaw_rad, CounterRandom* random,
                TriangleMesh* mesh);

}  // namespace trajlo::simulation
