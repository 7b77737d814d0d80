// SPDX-License-Identifier: MIT
#include "core/odometry/window/spurious_information.h"

#include <cmath>
#include <cstdint>

#include "core/odometry/map/voxel_index.h"
#include "manifolds/se3_interpolation.h"

namespace trajlo {
namespace {

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

/// sum a_i G_i G_iᵀ from the sums of a_i, a_i x_i and a_i x_i x_iᵀ.
Matrix6d IsotropicSum(double sum, const Eigen::Vector3d& first, const Eigen::Matrix3d& second) {
  Matrix6d result;
  result.topLeftCorner<3, 3>() = sum * Eigen::Matrix3d::Identity();
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
  const SE3 T_end_world = T_end.Inverse();
  const Eigen::Matrix3d R_end_world = T_end_world.q.toRotationMatrix();
  const double information = 1.0 / (noise.sigma_m * noise.sigma_m);
  SpuriousInformation spurious;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  Matrix6d along_normals = Matrix6d::Zero();
  for (const RegistrationPoint& point : points) {
    const Eigen::Vector3d x_world = motion.ToWorld(point.alpha, point.p_body_m);
    const double r = point.DistanceToPlane(x_world);
    const double weight = point.weight * information;
    const double w = weight * noise.kernel.Weight(weight * r * r);
    const Eigen::Vector3d x = R_end_world * x_world + T_end_world.t;
    const Eigen::Vector3d n = R_end_world * point.normal_world;
    Vector6d j;
    j << n, x.cross(n);
    const Matrix6d product = j * j.transpose();
    if (std::isinf(point.normal_variance_rad2)) {
      spurious.no_surface += w * product;
      continue;
    }
    const double a = w * point.normal_variance_rad2;
    spurious.by_place[GroupOf(x_world)] += w * product;
    along_normals += a * product;
    first += a * x;
    second.noalias() += a * x * x.transpose();
    spurious.sum += a;
    spurious.sum_of_squares += a * a;
  }
  spurious.mean = IsotropicSum(spurious.sum, first, second) - along_normals;
  return spurious;
}

}  // namespace trajlo
