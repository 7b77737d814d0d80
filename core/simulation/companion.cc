// SPDX-License-Identifier: MIT
#include "core/simulation/companion.h"

#include <cmath>
#include <utility>

#include "core/simulation/random/counter_random.h"
#include "core/simulation/scenes/scene_parts.h"
#include "core/simulation/scenes/triangle_mesh.h"

namespace trajlo::simulation {

using Eigen::Vector3d;

namespace {

/// Its foot, or the middle of the roof, is the origin; it looks along x.
TriangleMesh MeshOf(const std::string& kind) {
  CounterRandom random(0, 0, 0, 0);
  TriangleMesh mesh;
  if (kind == "person") AddPerson(Vector3d::Zero(), 0.0, &random, &mesh);
  if (kind == "car") AddCar(Vector3d::Zero(), 0.0, &random, &mesh);
  if (kind == "truck") {
    mesh.AddBoxOnGround({-1.5, 0.0, 1.1}, 0.0, {13.0, 2.5, 2.8}, 0.7);
    mesh.AddBoxOnGround({6.5, 0.0, 0.4}, 0.0, {2.2, 2.4, 2.9}, 0.4);
    for (const double x : {-6.5, -5.2, -3.9, 2.0, 6.5}) {
      for (const double y : {-1.1, 1.1}) {
        mesh.AddCylinder({x, y - 0.15, 0.5}, {x, y + 0.15, 0.5}, 0.5, 0.1, 12);
      }
    }
  }
  if (kind == "roof") mesh.AddBox({-1.1, -0.7, -0.05}, {1.1, 0.7, 0.0}, 0.5);
  return mesh;
}

/// Turned about the vertical only, as the body's x axis is.
Eigen::Quaterniond Heading(const Eigen::Quaterniond& q) {
  const Vector3d x = q * Vector3d::UnitX();
  return Eigen::Quaterniond(Eigen::AngleAxisd(std::atan2(x.y(), x.x()), Vector3d::UnitZ()));
}

}  // namespace

MovingObject MakeCompanion(const CompanionConfig& config, PoseFunction T_world_body) {
  auto pose = [config, T_world_body = std::move(T_world_body)](double t_s) {
    const SE3 T = T_world_body(t_s);
    const Eigen::Quaterniond q = config.kind == "roof" ? T.q : Heading(T.q);
    const double phase = 2.0 * M_PI * config.sway_hz * t_s;
    // Half as often to the side as forwards, as legs do it.
    const Vector3d sway(config.sway_m * std::sin(phase), config.sway_m * std::sin(0.5 * phase), 0);
    return SE3(q, T.t + q * (Vector3d(config.ahead_m, config.left_m, -config.below_m) + sway));
  };
  return {MeshOf(config.kind), pose};
}

std::vector<std::string> CompanionKinds() { return {"none", "person", "car", "truck", "roof"}; }

}  // namespace trajlo::simulation
