// SPDX-License-Identifier: MIT
#include "factors/point_to_plane.h"

#include <cmath>

#include "manifolds/se3_manifold.h"

namespace trajlo {

PointToPlaneCost::PointToPlaneCost(const RegistrationPoint& point, double sigma_m)
    : point_(point), scale_(std::sqrt(point.weight) / sigma_m) {}

bool PointToPlaneCost::Evaluate(double const* const* parameters, double* residuals,
                                double** jacobians) const {
  const SE3 T_begin = SE3::FromData(parameters[0]);
  const SE3 T_end = SE3::FromData(parameters[1]);
  const Vector6d tau = Minus(T_end, T_begin);
  const SE3 T = Plus(T_begin, point_.alpha * tau);
  const Eigen::Vector3d& n = point_.normal_world;

  residuals[0] = scale_ * (n.dot(T * point_.p_body_m) - point_.offset_m);
  if (jacobians == nullptr) return true;

  const Eigen::Matrix3d R = T.q.toRotationMatrix();
  Eigen::Matrix<double, 1, 6> dr_dphi;
  dr_dphi << n.transpose() * R, -n.transpose() * R * so3::Hat(point_.p_body_m);
  dr_dphi *= scale_;
  const InterpolationJacobians dphi = InterpolateJacobians(tau, point_.alpha);

  using Row7 = Eigen::Matrix<double, 1, 7, Eigen::RowMajor>;
  if (jacobians[0] != nullptr) {
    Eigen::Map<Row7> J(jacobians[0]);
    J = dr_dphi * dphi.wrt_begin * Se3MinusJacobian(T_begin);
  }
  if (jacobians[1] != nullptr) {
    Eigen::Map<Row7> J(jacobians[1]);
    J = dr_dphi * dphi.wrt_end * Se3MinusJacobian(T_end);
  }
  return true;
}

}  // namespace trajlo
