// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "manifolds/se3.h"

namespace trajlo::simulation {

/// What a scene is made of: triangles, seen from both sides. Metres.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Diffuse reflectivity of each triangle, 0 to 1.
  std::vector<float> reflectivity;

  void AddTriangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                   double reflectivity_of_it);
  /// Corners in order around the quadrilateral.
  void AddQuad(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
               const Eigen::Vector3d& d, double reflectivity_of_it);
  /// An axis-parallel box from `low` to `high`.
  void AddBox(const Eigen::Vector3d& low, const Eigen::Vector3d& high, double reflectivity_of_it);
  /// A box of `size` that stands on `base` (the middle of its bottom), turned about the vertical.
  void AddBoxOnGround(const Eigen::Vector3d& base, double yaw_rad, const Eigen::Vector3d& size,
                      double reflectivity_of_it);
  /// A closed cylinder (a prism with `sides` faces) from the middle of one end to that of the
  /// other.
  void AddCylinder(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius_m,
                   double reflectivity_of_it, int sides = 24);
  /// A sphere of `rings` bands of latitude.
  void AddSphere(const Eigen::Vector3d& centre, double radius_m, double reflectivity_of_it,
                 int rings = 8);
  /// The surface z = height(x, y) over a rectangle, as cells of about `cell_m`.
  void AddHeightField(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double cell_m,
                      const std::function<double(double x, double y)>& height,
                      double reflectivity_of_it);
  /// Another mesh, placed by T_this_other.
  void AddMesh(const TriangleMesh& other, const SE3& T_this_other);
};

}  // namespace trajlo::simulation
