// SPDX-License-Identifier: MIT
#include "core/odometry/window/spurious_information.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/odometry/map/voxel_index.h"
#include "factors/registration_lanes.h"

namespace trajlo {
namespace {

using lanes::Broadcast;
using lanes::Broadcast3;
using lanes::Lane4;
using lanes::Vector3;
using registration_lanes::kLanes;
using registration_lanes::LocatedPoints;

/// The edge of a place: planes that are nearer to each other are fitted to points in common.
constexpr double kPlace_m = 0.5;

/// Which group the place of a point belongs to, as if by chance.
std::size_t GroupOf(const Eigen::Vector3d& x_world) {
  const VoxelKey place = VoxelAt(x_world, 1.0 / kPlace_m);
  std::uint64_t hash = 0;
  for (const int coordinate : {place.x(), place.y(), place.z()}) {
    hash = (hash ^ static_cast<std::uint32_t>(coordinate)) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 32;
  }
  return hash % SpuriousInformation::kGroups;
}

/// Four points, with a vector of lanes for each.
struct PointVectors {
  Lane4 y[kLanes];                            ///< [p0; 1]
  Lane4 j_head[kLanes], j_tail[kLanes] = {};  ///< j = [n0; p0 x n0], of six
  std::array<Eigen::Vector3d, kLanes> world;  ///< Their places.

  PointVectors(const LocatedPoints& at, const SegmentMotion& motion)
      : y{at.p0.x, at.p0.y, at.p0.z, Broadcast<Lane4>(1.0)}, j_head{at.n0.x, at.n0.y, at.n0.z} {
    const Vector3<Lane4> moment = lanes::Cross(at.p0, at.n0);
    j_head[3] = moment.x;
    j_tail[0] = moment.y;
    j_tail[1] = moment.z;
    const Vector3<Lane4> x =
        lanes::Rotate(motion.R_begin, at.p0) + Broadcast3<Lane4>(motion.t_begin);
    for (std::size_t i = 0; i < kLanes; ++i) world[i] = {x.x[i], x.y[i], x.z[i]};
    for (Lane4* rows : {y, j_head, j_tail}) {
      lanes::Transpose(&rows[0], &rows[1], &rows[2], &rows[3]);
    }
  }
};

/// sum a j jᵀ.
struct JacobianProducts {
  Lane4 head[6] = {}, tail[6] = {};

  void Add(double a, const Lane4& j_head, const Lane4& j_tail) {
    for (int row = 0; row < 6; ++row) {
      const double a_j = a * (row < 4 ? j_head[row] : j_tail[row - 4]);
      head[row] += a_j * j_head;
      tail[row] += a_j * j_tail;
    }
  }
  Matrix6d Sum() const {
    Matrix6d sum;
    for (int row = 0; row < 6; ++row) {
      for (int i = 0; i < 4; ++i) sum(row, i) = head[row][i];
      for (int i = 0; i < 2; ++i) sum(row, 4 + i) = tail[row][i];
    }
    return sum;
  }
};

/// sum a G Gᵀ, G = [I; [p0]x], from the sum of a y yᵀ.
Matrix6d IsotropicSum(const Lane4 (&a_yy)[4]) {
  const Eigen::Vector3d first(a_yy[3][0], a_yy[3][1], a_yy[3][2]);
  Eigen::Matrix3d second;
  for (int row = 0; row < 3; ++row) {
    for (int i = 0; i < 3; ++i) second(row, i) = a_yy[row][i];
  }
  Matrix6d result;
  result.topLeftCorner<3, 3>() = a_yy[3][3] * Eigen::Matrix3d::Identity();
  result.bottomLeftCorner<3, 3>() = so3::Hat(first);
  result.topRightCorner<3, 3>() = so3::Hat(first).transpose();
  result.bottomRightCorner<3, 3>() = second.trace() * Eigen::Matrix3d::Identity() - second;
  return result;
}

}  // namespace

SpuriousInformation SpuriousInformationOf(const std::vector<RegistrationPoint>& points,
                                          const SE3& T_begin, const SE3& T_end,
                                          const RegistrationNoise& noise) {
  const SegmentMotion motion(T_begin, T_end);
  const double information = 1.0 / (noise.sigma_m * noise.sigma_m);
  const registration_lanes::AxisKernels kernels(noise);
  SpuriousInformation spurious;
  JacobianProducts along_normals, no_surface, by_place[SpuriousInformation::kGroups];
  Lane4 a_yy[4] = {};
  for (std::size_t first = 0; first < points.size(); first += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, points.size() - first);
    const LocatedPoints at(registration_lanes::Gather(&points[first], count), motion);
    const Lane4 weight = information * at.weight;
    const Lane4 w = weight * kernels.Weight(at.axis, weight * at.r * at.r);
    const PointVectors vectors(at, motion);
    for (std::size_t i = 0; i < count; ++i) {
      const double variance = points[first + i].normal_variance_rad2;
      const Lane4 &head = vectors.j_head[i], &tail = vectors.j_tail[i], &y = vectors.y[i];
      if (std::isinf(variance)) {
        no_surface.Add(w[i], head, tail);
        continue;
      }
      const double a = w[i] * variance;
      by_place[GroupOf(vectors.world[i])].Add(w[i], head, tail);
      along_normals.Add(a, head, tail);
      for (int row = 0; row < 4; ++row) a_yy[row] += (a * y[row]) * y;
      spurious.sum_of_squares += a * a;
    }
  }
  spurious.sum = a_yy[3][3];
  spurious.mean = IsotropicSum(a_yy) - along_normals.Sum();
  spurious.no_surface = no_surface.Sum();
  for (std::size_t i = 0; i < spurious.by_place.size(); ++i) {
    spurious.by_place[i] = by_place[i].Sum();
  }
  return spurious;
}

}  // namespace trajlo
