// SPDX-License-Identifier: MIT
#include "manifolds/se3_interpolation.h"

namespace trajlo {

SegmentMotion::SegmentMotion(const SE3& T_begin, const SE3& T_end)
    : R_begin(T_begin.q.toRotationMatrix()), t_begin(T_begin.t), tau(Minus(T_end, T_begin)) {
  rho = tau.head<3>();
  theta = tau.tail<3>();
  theta_x_rho = theta.cross(rho);
  theta_x_theta_x_rho = theta.cross(theta_x_rho);
  angle_squared = theta.squaredNorm();
}

InterpolationJacobians InterpolateJacobians(const Vector6d& tau, double alpha) {
  return {(1.0 - alpha) * se3::RightJacobian((alpha - 1.0) * tau) * se3::LeftJacobianInverse(tau),
          alpha * se3::RightJacobian(alpha * tau) * se3::RightJacobianInverse(tau)};
}

}  // namespace trajlo
