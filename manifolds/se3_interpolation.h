// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "manifolds/lanes.h"
#include "manifolds/se3.h"

namespace trajlo {

/// The pose within a segment (paper eq. 1): phi(alpha) = T_begin ⊕ alpha tau with
/// tau = T_end ⊖ T_begin; alpha is 0 at the start and 1 at the end of the segment.
inline SE3 Interpolate(const SE3& T_begin, const SE3& T_end, double alpha) {
  return Plus(T_begin, alpha * Minus(T_end, T_begin));
}

/// The constant twist of one segment, prepared for moving many of its points:
///
///   Interpolate(T_begin, T_end, alpha) p = T_begin p0,
///   p0 = Exp(alpha tau) p = p + alpha c1 theta x p + alpha² c2 theta x (theta x p)
///                         + alpha rho + alpha² c2 theta x rho + alpha³ c3 theta x (theta x rho),
///
/// with the Stumpff functions at alpha |theta|; a fraction of the cost of the general formula. T is
/// a double, or four of them (lanes.h).
struct SegmentMotion {
  SegmentMotion(const SE3& T_begin, const SE3& T_end);

  /// p0; `c` are the Stumpff functions at alpha² angle_squared.
  template <typename T>
  lanes::Vector3<T> MoveToBegin(const T& alpha, const StumpffSeries<T>& c,
                                const lanes::Vector3<T>& p) const {
    const lanes::Vector3<T> axis = lanes::Broadcast3<T>(theta);
    const lanes::Vector3<T> axis_x_p = lanes::Cross(axis, p);
    const T k1 = alpha * c.c1;
    const T k2 = alpha * alpha * c.c2;
    const T k3 = alpha * alpha * alpha * c.c3;
    return p + k1 * axis_x_p +
           k2 * (lanes::Cross(axis, axis_x_p) + lanes::Broadcast3<T>(theta_x_rho)) +
           alpha * lanes::Broadcast3<T>(rho) + k3 * lanes::Broadcast3<T>(theta_x_theta_x_rho);
  }

  /// The Stumpff functions at alpha² angle_squared.
  StumpffSeries<lanes::Lane4> StumpffAt(const lanes::Lane4& alpha) const {
    const lanes::Lane4 s = alpha * alpha * angle_squared;
    StumpffSeries<lanes::Lane4> c(s, std::min(angle_squared, 1.0));
    for (int i = 0; i < 4 && angle_squared > 1.0; ++i) {
      const Stumpff at(s[i]);
      c.c0[i] = at.c0;
      c.c1[i] = at.c1;
      c.c2[i] = at.c2;
      c.c3[i] = at.c3;
      c.c4[i] = at.c4;
      c.c5[i] = at.c5;
    }
    return c;
  }

  /// Four points in the world.
  lanes::Vector3<lanes::Lane4> ToWorld(const lanes::Lane4& alpha,
                                       const lanes::Vector3<lanes::Lane4>& p) const {
    return lanes::Rotate(R_begin, MoveToBegin(alpha, StumpffAt(alpha), p)) +
           lanes::Broadcast3<lanes::Lane4>(t_begin);
  }

  /// The point in the world.
  Eigen::Vector3d ToWorld(double alpha, const Eigen::Vector3d& p) const {
    const Stumpff c(alpha * alpha * angle_squared);
    const auto p0 = MoveToBegin<double>(alpha, c, {p.x(), p.y(), p.z()});
    return R_begin * Eigen::Vector3d(p0.x, p0.y, p0.z) + t_begin;
  }

  Eigen::Matrix3d R_begin;
  Eigen::Vector3d t_begin;
  Vector6d tau;  ///< [rho; theta], in the begin frame.
  Eigen::Vector3d rho, theta, theta_x_rho, theta_x_theta_x_rho;
  double angle_squared;
};

/// The derivatives of the interpolated pose, all with respect to right perturbations.
struct InterpolationJacobians {
  Matrix6d wrt_begin;  ///< (1 - alpha) Jr((alpha - 1) tau) Jl⁻¹(tau), paper's Jacobian c.
  Matrix6d wrt_end;    ///< alpha Jr(alpha tau) Jr⁻¹(tau), paper's Jacobian d.
};

InterpolationJacobians InterpolateJacobians(const Vector6d& tau, double alpha);

}  // namespace trajlo
