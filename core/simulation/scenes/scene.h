// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "core/simulation/motions/pose_function.h"
#include "core/simulation/scenes/triangle_mesh.h"

namespace trajlo::simulation {

/// Something in the scene that does not stand still: a car, a person.
struct MovingObject {
  TriangleMesh mesh;
  PoseFunction T_world_object;
};

/// Where a ray met a surface.
struct RayHit {
  double range_m = 0.0;
  /// Unit normal of the surface on the side of the ray's origin, world frame.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  float reflectivity = 0.0F;
};

/// A world that rays can be cast into. Embree finds the triangle; the distance is then
/// computed from its plane in double precision, so that it is exact far from the origin as well.
/// Immutable, and safe to use from many threads.
class Scene {
 public:
  explicit Scene(TriangleMesh fixed, std::vector<MovingObject> moving_objects = {});
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  /// The first surface on the ray within `max_range_m`. `direction` is a unit vector in the world
  /// frame; `t_s` tells where the moving objects are.
  std::optional<RayHit> CastRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                double t_s, double max_range_m) const;

  /// The fixed part.
  const TriangleMesh& mesh() const;

 private:
  struct Part;
  std::vector<std::unique_ptr<Part>> parts_;  // The first is the fixed part.
};

}  // namespace trajlo::simulation
