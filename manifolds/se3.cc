// SPDX-License-Identifier: MIT
#include "manifolds/se3.h"

namespace trajlo::se3 {

Matrix6d AdjointAlgebra(const Vector6d& tau) {
  Matrix6d ad = Matrix6d::Zero();
  ad.topLeftCorner<3, 3>() = so3::Hat(tau.tail<3>());
  ad.topRightCorner<3, 3>() = so3::Hat(tau.head<3>());
  ad.bottomRightCorner<3, 3>() = ad.topLeftCorner<3, 3>();
  return ad;
}

Matrix6d Adjoint(const SE3& T) {
  const Eigen::Matrix3d R = T.q.toRotationMatrix();
  Matrix6d adjoint = Matrix6d::Zero();
  adjoint.topLeftCorner<3, 3>() = R;
  adjoint.topRightCorner<3, 3>() = so3::Hat(T.t) * R;
  adjoint.bottomRightCorner<3, 3>() = R;
  return adjoint;
}

SE3 Exp(const Vector6d& tau) {
  const Eigen::Vector3d rho = tau.head<3>();
  const Eigen::Vector3d theta = tau.tail<3>();
  const Stumpff s(theta.squaredNorm());
  const Eigen::Vector3d theta_x_rho = theta.cross(rho);
  return {so3::Exp(theta), rho + s.c2 * theta_x_rho + s.c3 * theta.cross(theta_x_rho)};
}

Vector6d Log(const SE3& T) {
  Vector6d tau;
  tau.tail<3>() = so3::Log(T.q);
  tau.head<3>() = so3::LeftJacobianInverse(tau.tail<3>()) * T.t;
  return tau;
}

Matrix6d LeftJacobian(const Vector6d& tau) {
  const LeftJacobianCoefficients<double> a(Stumpff(tau.tail<3>().squaredNorm()));
  const Matrix6d I = Matrix6d::Identity();
  const Matrix6d ad = AdjointAlgebra(tau);
  return I + ad * (a.a1 * I + ad * (a.a2 * I + ad * (a.a3 * I + a.a4 * ad)));
}

Matrix6d LeftJacobianInverse(const Vector6d& tau) {
  const Eigen::Matrix3d Ji = so3::LeftJacobianInverse(tau.tail<3>());
  const Eigen::Matrix3d Q = LeftJacobian(tau).topRightCorner<3, 3>();
  Matrix6d inverse = Matrix6d::Zero();
  inverse.topLeftCorner<3, 3>() = Ji;
  inverse.topRightCorner<3, 3>() = -Ji * Q * Ji;
  inverse.bottomRightCorner<3, 3>() = Ji;
  return inverse;
}

}  // namespace trajlo::se3
