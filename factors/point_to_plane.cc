// SPDX-License-Identifier: MIT
#include "factors/point_to_plane.h"

#include <cmath>

#include "manifolds/se3_manifold.h"

namespace trajlo {

double EvaluatePointToPlane(const RegistrationPoint& point, double sigma_m, const SE3& T_begin,
                            const SE3& T_end, Eigen::Matrix<double, 1, 12>* wrt_poses) {
  const double scale = std::sqrt(point.weight) / sigma_m;
  const Eigen::Vector3d& n = point.normal_world;
  const Vector6d tau = Minus(T_end, T_begin);
  const SE3 T = Plus(T_begin, point.alpha * tau);
  const double residual = scale * point.DistanceToPlane(T * point.p_body_m);
  if (wrt_poses == nullptr) return residual;

  const Eigen::Matrix3d R = T.q.toRotationMatrix();
  Eigen::Matrix<double, 1, 6> dr_dphi;
  dr_dphi << n.transpose() * R, -n.transpose() * R * so3::Hat(point.p_body_m);
  dr_dphi *= scale;
  const InterpolationJacobians dphi = InterpolateJacobians(tau, point.alpha);
  *wrt_poses << dr_dphi * dphi.wrt_begin, dr_dphi * dphi.wrt_end;
  return residual;
}

bool PointToPlaneCost::Evaluate(double const* const* parameters, double* residuals,
                                double** jacobians) const {
  const SE3 poses[2] = {SE3::FromData(parameters[0]), SE3::FromData(parameters[1])};
  Eigen::Matrix<double, 1, 12> wrt_poses;
  residuals[0] = EvaluatePointToPlane(point_, sigma_m_, poses[0], poses[1],
                                      jacobians == nullptr ? nullptr : &wrt_poses);
  if (jacobians != nullptr) WriteJacobians(poses, wrt_poses, jacobians);
  return true;
}

}  // namespace trajlo
