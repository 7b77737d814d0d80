// SPDX-License-Identifier: MIT
#include "core/odometry/window/feigned_information.h"

#include "manifolds/se3_interpolation.h"

namespace trajlo {

FeignedInformation FeignedBy(const std::vector<RegistrationPoint>& points, const SE3& T_begin,
                             const SE3& T_end, const RegistrationNoise& noise) {
  const SegmentMotion motion(T_begin, T_end);
  const SE3 T_end_world = T_end.Inverse();
  const Eigen::Matrix3d R_end_world = T_end_world.q.toRotationMatrix();
  const double information = 1.0 / (noise.sigma_m * noise.sigma_m);
  FeignedInformation feigned;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  Matrix6d along_normals = Matrix6d::Zero();
  for (const RegistrationPoint& point : points) {
    const Eigen::Vector3d x_world = motion.ToWorld(point.alpha, point.p_body_m);
    const double r = point.normal_world.dot(x_world) - point.offset_m;
    const double weight = point.weight * information;
    const double a = weight * noise.kernel.Weight(weight * r * r) * point.normal_variance_rad2;
    const Eigen::Vector3d x = R_end_world * x_world + T_end_world.t;
    const Eigen::Vector3d n = R_end_world * point.normal_world;
    Vector6d j;
    j << n, x.cross(n);
    along_normals.noalias() += a * j * j.transpose();
    first += a * x;
    second.noalias() += a * x * x.transpose();
    feigned.sum += a;
    feigned.sum_of_squares += a * a;
  }
  // sum_i a_i G_i G_iᵀ
  feigned.mean.topLeftCorner<3, 3>().setIdentity();
  feigned.mean.topLeftCorner<3, 3>() *= feigned.sum;
  feigned.mean.bottomLeftCorner<3, 3>() = so3::Hat(first);
  feigned.mean.topRightCorner<3, 3>() = so3::Hat(first).transpose();
  feigned.mean.bottomRightCorner<3, 3>() = second.trace() * Eigen::Matrix3d::Identity() - second;
  feigned.mean -= along_normals;
  return feigned;
}

}  // namespace trajlo
