// SPDX-License-Identifier: MIT
#pragma once

#include "manifolds/se3.h"

namespace trajlo {

/// The pose within a segment (paper eq. 1): phi(alpha) = T_begin ⊕ alpha tau with
/// tau = T_end ⊖ T_begin; alpha is 0 at the begin and 1 at the end of the segment.
inline SE3 Interpolate(const SE3& T_begin, const SE3& T_end, double alpha) {
  return Plus(T_begin, alpha * Minus(T_end, T_begin));
}

/// Interpolate(T_begin, T_end, alpha) * p for many points of one segment:
///
///   T_begin (p + alpha c1 theta x p + alpha² c2 theta x (theta x p)
///            + alpha rho + alpha² c2 theta x rho + alpha³ c3 theta x (theta x rho)),
///
/// with the Stumpff functions at alpha |theta|; a fraction of the cost of the general formula.
class PointInterpolator {
 public:
  PointInterpolator(const SE3& T_begin, const SE3& T_end)
      : R_begin_(T_begin.q.toRotationMatrix()), t_begin_(T_begin.t) {
    const Vector6d tau = Minus(T_end, T_begin);
    rho_ = tau.head<3>();
    theta_ = tau.tail<3>();
    theta_x_rho_ = theta_.cross(rho_);
    theta_x_theta_x_rho_ = theta_.cross(theta_x_rho_);
    angle_squared_ = theta_.squaredNorm();
  }

  Eigen::Vector3d operator()(double alpha, const Eigen::Vector3d& p) const {
    const Stumpff c(alpha * alpha * angle_squared_);
    const Eigen::Vector3d theta_x_p = theta_.cross(p);
    const double k1 = alpha * c.c1;
    const double k2 = alpha * alpha * c.c2;
    const double k3 = alpha * alpha * alpha * c.c3;
    return R_begin_ * (p + k1 * theta_x_p + k2 * (theta_.cross(theta_x_p) + theta_x_rho_) +
                       alpha * rho_ + k3 * theta_x_theta_x_rho_) +
           t_begin_;
  }

 private:
  Eigen::Matrix3d R_begin_;
  Eigen::Vector3d t_begin_, rho_, theta_, theta_x_rho_, theta_x_theta_x_rho_;
  double angle_squared_;
};

/// The derivatives of the interpolated pose, all with respect to right perturbations.
struct InterpolationJacobians {
  Matrix6d wrt_begin;  ///< (1 - alpha) Jr((alpha - 1) tau) Jl⁻¹(tau), paper's Jacobian c.
  Matrix6d wrt_end;    ///< alpha Jr(alpha tau) Jr⁻¹(tau), paper's Jacobian d.
};

inline InterpolationJacobians InterpolateJacobians(const Vector6d& tau, double alpha) {
  return {(1.0 - alpha) * se3::RightJacobian((alpha - 1.0) * tau) * se3::LeftJacobianInverse(tau),
          alpha * se3::RightJacobian(alpha * tau) * se3::RightJacobianInverse(tau)};
}

}  // namespace trajlo
