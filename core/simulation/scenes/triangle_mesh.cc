// SPDX-License-Identifier: MIT
#include "core/simulation/scenes/triangle_mesh.h"

#include <algorithm>
#include <cmath>

namespace trajlo::simulation {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// The eight corners of a box, bit 0 of the index for x, bit 1 for y, bit 2 for z.
std::array<Vector3d, 8> Corners(const Vector3d& low, const Vector3d& high) {
  std::array<Vector3d, 8> corners;
  for (unsigned i = 0; i < 8; ++i) {
    corners[i] = {(i & 1U) != 0 ? high.x() : low.x(), (i & 2U) != 0 ? high.y() : low.y(),
                  (i & 4U) != 0 ? high.z() : low.z()};
  }
  return corners;
}

void AddHexahedron(const std::array<Vector3d, 8>& c, double reflectivity, TriangleMesh* mesh) {
  mesh->AddQuad(c[0], c[1], c[3], c[2], reflectivity);
  mesh->AddQuad(c[4], c[5], c[7], c[6], reflectivity);
  mesh->AddQuad(c[0], c[1], c[5], c[4], reflectivity);
  mesh->AddQuad(c[2], c[3], c[7], c[6], reflectivity);
  mesh->AddQuad(c[0], c[2], c[6], c[4], reflectivity);
  mesh->AddQuad(c[1], c[3], c[7], c[5], reflectivity);
}

}  // namespace

void TriangleMesh::AddTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                               double reflectivity_of_it) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  vertices.emplace_back(a.cast<float>());
  vertices.emplace_back(b.cast<float>());
  vertices.emplace_back(c.cast<float>());
  triangles.push_back({first, first + 1, first + 2});
  reflectivity.push_back(static_cast<float>(reflectivity_of_it));
}

void TriangleMesh::AddQuad(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                           const Vector3d& d, double reflectivity_of_it) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (const Vector3d* corner : {&a, &b, &c, &d}) vertices.emplace_back(corner->cast<float>());
  triangles.push_back({first, first + 1, first + 2});
  triangles.push_back({first, first + 2, first + 3});
  reflectivity.insert(reflectivity.end(), 2, static_cast<float>(reflectivity_of_it));
}

void TriangleMesh::AddBox(const Vector3d& low, const Vector3d& high, double reflectivity_of_it) {
  AddHexahedron(Corners(low, high), reflectivity_of_it, this);
}

void TriangleMesh::AddBoxOnGround(const Vector3d& base, double yaw_rad, const Vector3d& size,
                                  double reflectivity_of_it) {
  const Vector3d half(0.5 * size.x(), 0.5 * size.y(), 0.0);
  std::array<Vector3d, 8> corners = Corners(-half, half + Vector3d(0.0, 0.0, size.z()));
  const Eigen::AngleAxisd turn(yaw_rad, Vector3d::UnitZ());
  for (Vector3d& corner : corners) corner = base + turn * corner;
  AddHexahedron(corners, reflectivity_of_it, this);
}

void TriangleMesh::AddCylinder(const Vector3d& from, const Vector3d& to, double radius_m,
                               double reflectivity_of_it, int sides) {
  const Vector3d axis = (to - from).normalized();
  const Vector3d u = axis.unitOrthogonal() * radius_m;
  const Vector3d v = axis.cross(u);
  const auto rim = [&](int i) -> Vector3d {
    const double angle = 2.0 * M_PI * i / sides;
    return std::cos(angle) * u + std::sin(angle) * v;
  };
  for (int i = 0; i < sides; ++i) {
    const Vector3d a = rim(i);
    const Vector3d b = rim((i + 1) % sides);
    AddQuad(from + a, from + b, to + b, to + a, reflectivity_of_it);
    AddTriangle(from, from + a, from + b, reflectivity_of_it);
    AddTriangle(to, to + a, to + b, reflectivity_of_it);
  }
}

void TriangleMesh::AddSphere(const Vector3d& centre, double radius_m, double reflectivity_of_it,
                             int rings) {
  const int sectors = 2 * rings;
  const auto at = [&](int ring, int sector) -> Vector3d {
    const double polar = M_PI * ring / rings;
    const double azimuth = 2.0 * M_PI * (sector % sectors) / sectors;
    return centre + radius_m * Vector3d(std::sin(polar) * std::cos(azimuth),
                                        std::sin(polar) * std::sin(azimuth), std::cos(polar));
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int sector = 0; sector < sectors; ++sector) {
      if (ring > 0) {
        AddTriangle(at(ring, sector), at(ring, sector + 1), at(ring + 1, sector),
                    reflectivity_of_it);
      }
      if (ring + 1 < rings) {
        AddTriangle(at(ring, sector + 1), at(ring + 1, sector), at(ring + 1, sector + 1),
                    reflectivity_of_it);
      }
    }
  }
}

void TriangleMesh::AddHeightField(const Vector2d& low, const Vector2d& high, double cell_m,
                                  const std::function<double(double, double)>& height,
                                  double reflectivity_of_it) {
  const Vector2d size = high - low;
  const int nx = std::max(1, static_cast<int>(std::ceil(size.x() / cell_m)));
  const int ny = std::max(1, static_cast<int>(std::ceil(size.y() / cell_m)));
  const auto at = [&](int ix, int iy) -> Vector3d {
    const double x = low.x() + size.x() * ix / nx;
    const double y = low.y() + size.y() * iy / ny;
    return {x, y, height(x, y)};
  };
  for (int ix = 0; ix < nx; ++ix) {
    for (int iy = 0; iy < ny; ++iy) {
      AddQuad(at(ix, iy), at(ix + 1, iy), at(ix + 1, iy + 1), at(ix, iy + 1), reflectivity_of_it);
    }
  }
}

void TriangleMesh::AddMesh(const TriangleMesh& other, const SE3& T_this_other) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (const Eigen::Vector3f& p : other.vertices) {
    vertices.emplace_back((T_this_other * p.cast<double>()).cast<float>());
  }
  for (const auto& t : other.triangles) {
    triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  reflectivity.insert(reflectivity.end(), other.reflectivity.begin(), other.reflectivity.end());
}

}  // namespace trajlo::simulation
