// SPDX-License-Identifier: MIT
#include "core/simulation/scenes/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "core/simulation/scenes/embree.h"

namespace trajlo::simulation {

using Eigen::Vector3d;

namespace {

/// One device serves the whole process. It is left to its default number of threads: any other
/// would limit oneTBB for the whole process, as Embree runs on it too.
RTCDevice EmbreeDevice() {
  static const RTCDevice device = rtcNewDevice(nullptr);
  if (device == nullptr) throw std::runtime_error("Embree cannot create its device");
  return device;
}

RTCScene BuildEmbreeScene(const TriangleMesh& mesh) {
  RTCDevice device = EmbreeDevice();
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               mesh.vertices.size()));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh.triangles.size()));
  for (const Eigen::Vector3f& p : mesh.vertices) vertices = std::copy_n(p.data(), 3, vertices);
  for (const auto& triangle : mesh.triangles) indices = std::copy_n(triangle.data(), 3, indices);
  rtcCommitGeometry(geometry);
  RTCScene scene = rtcNewScene(device);
  // Robust: a ray that runs along an edge shared by two walls must not slip through it.
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

}  // namespace

struct Scene::Part {
  TriangleMesh mesh;
  PoseFunction T_world_part;  // Empty for the fixed part.
  double radius_m = 0.0;      // Of the sphere about the part's origin that holds it.
  RTCScene scene = nullptr;

  Part(TriangleMesh m, PoseFunction pose)
      : mesh(std::move(m)), T_world_part(std::move(pose)), scene(BuildEmbreeScene(mesh)) {
    for (const Eigen::Vector3f& p : mesh.vertices) {
      radius_m = std::max(radius_m, static_cast<double>(p.norm()));
    }
  }
  ~Part() { rtcReleaseScene(scene); }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  /// In the part's own frame.
  std::optional<RayHit> CastRay(const Vector3d& origin, const Vector3d& direction,
                                double max_range_m) const {
    RTCRayHit query{};
    const Eigen::Vector3f o = origin.cast<float>();
    const Eigen::Vector3f d = direction.cast<float>();
    query.ray.org_x = o.x();
    query.ray.org_y = o.y();
    query.ray.org_z = o.z();
    query.ray.dir_x = d.x();
    query.ray.dir_y = d.y();
    query.ray.dir_z = d.z();
    query.ray.tfar = static_cast<float>(max_range_m);
    query.ray.mask = 0xffffffffU;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    Intersect(scene, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

    const auto& t = mesh.triangles[query.hit.primID];
    const Vector3d a = mesh.vertices[t[0]].cast<double>();
    const Vector3d b = mesh.vertices[t[1]].cast<double>();
    const Vector3d c = mesh.vertices[t[2]].cast<double>();
    RayHit hit;
    hit.normal = (b - a).cross(c - a).normalized();
    const double slope = hit.normal.dot(direction);
    hit.range_m = slope != 0.0 ? hit.normal.dot(a - origin) / slope : query.ray.tfar;
    // A grazing ray amplifies the rounding of the vertices: fall back on Embree's own distance.
    if (std::abs(hit.range_m - query.ray.tfar) > 1e-2) hit.range_m = query.ray.tfar;
    if (slope > 0.0) hit.normal = -hit.normal;
    hit.reflectivity = mesh.reflectivity[query.hit.primID];
    return hit;
  }
};

Scene::Scene(TriangleMesh fixed, std::vector<MovingObject> moving_objects) {
  parts_.push_back(std::make_unique<Part>(std::move(fixed), nullptr));
  for (MovingObject& object : moving_objects) {
    parts_.push_back(
        std::make_unique<Part>(std::move(object.mesh), std::move(object.T_world_object)));
  }
}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

const TriangleMesh& Scene::mesh() const { return parts_.front()->mesh; }

std::optional<RayHit> Scene::CastRay(const Vector3d& origin, const Vector3d& direction, double t_s,
                                     double max_range_m) const {
  std::optional<RayHit> nearest = parts_.front()->CastRay(origin, direction, max_range_m);
  for (std::size_t i = 1; i < parts_.size(); ++i) {
    const Part& part = *parts_[i];
    const SE3 T_world_part = part.T_world_part(t_s);
    const Vector3d to_part = T_world_part.t - origin;
    const double along = to_part.dot(direction);
    const double reach = nearest ? nearest->range_m : max_range_m;
    if (along < -part.radius_m || along > reach + part.radius_m) continue;
    if (to_part.squaredNorm() - along * along > part.radius_m * part.radius_m) continue;
    const SE3 T_part_world = T_world_part.Inverse();
    std::optional<RayHit> hit =
        part.CastRay(T_part_world * origin, T_part_world.q * direction, reach);
    if (!hit) continue;
    hit->normal = T_world_part.q * hit->normal;
    nearest = hit;
  }
  return nearest;
}

}  // namespace trajlo::simulation
