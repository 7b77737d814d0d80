// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "manifolds/so3.h"
#include "manifolds/stumpff.h"

namespace trajlo {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// A rigid transform. `T_a_b` maps coordinates of frame b to frame a: p_a = q * p_b + t (metres).
/// The members in memory order are Ceres's parameter block [qx qy qz qw tx ty tz].
struct SE3 {
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();

  SE3() = default;
  SE3(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation)
      : q(rotation), t(translation) {}

  SE3 Inverse() const { return {q.conjugate(), -(q.conjugate() * t)}; }

  SE3 operator*(const SE3& other) const { return {(q * other.q).normalized(), q * other.t + t}; }
  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const { return q * p + t; }

  /// The parameter block of this transform: 7 doubles [qx qy qz qw tx ty tz].
  double* data() { return q.coeffs().data(); }
  const double* data() const { return q.coeffs().data(); }

  /// Reads a parameter block of 7 doubles.
  static SE3 FromData(const double* x) {
    return {Eigen::Quaterniond(x[3], x[0], x[1], x[2]), Eigen::Vector3d(x[4], x[5], x[6])};
  }

  bool IsFinite() const { return q.coeffs().allFinite() && t.allFinite(); }
};
static_assert(sizeof(SE3) == 7 * sizeof(double) || sizeof(SE3) == 8 * sizeof(double),
              "q and t must be adjacent for data() to be one parameter block");

/// SE(3): tangent vectors are tau = [rho; theta], translation (m) before rotation (rad), with the
/// full exponential (rho is not the translation). Formulas: Solà et al. 2018, appendix D;
/// Barfoot 2017, section 8.1.5 (the Jacobian as a polynomial in ad).
namespace se3 {

/// ad(tau) = [[theta]x [rho]x; 0 [theta]x].
Matrix6d AdjointAlgebra(const Vector6d& tau);

/// Adj(T) = [R [t]x R; 0 R], so that T Exp(tau) = Exp(Adj(T) tau) T.
Matrix6d Adjoint(const SE3& T);

/// Exp(tau) = (Exp(theta), Jl(theta) rho).
SE3 Exp(const Vector6d& tau);

/// Log(T) = [Jl⁻¹(theta) t; theta], |theta| <= pi.
Vector6d Log(const SE3& T);

/// The coefficients of Jl(tau) = I + a1 ad + a2 ad² + a3 ad³ + a4 ad⁴: the series
/// sum ad^n / (n+1)! closed by (ad² + |theta|²)² ad = 0. Given in Stumpff functions of |theta|.
template <typename T>
struct LeftJacobianCoefficients {
  T a1, a2, a3, a4;
  explicit LeftJacobianCoefficients(const StumpffSeries<T>& s)
      : a1(0.5 * (4.0 * s.c2 - s.c1)),
        a2(0.5 * (5.0 * s.c3 - s.c2)),
        a3(0.5 * (s.c3 - 2.0 * s.c4)),
        a4(0.5 * (s.c4 - 3.0 * s.c5)) {}
};

/// Jl(tau): Exp(tau + d) = Exp(Jl(tau) d) Exp(tau) to first order.
Matrix6d LeftJacobian(const Vector6d& tau);

/// Jr(tau) = Jl(-tau): Exp(tau + d) = Exp(tau) Exp(Jr(tau) d) to first order.
inline Matrix6d RightJacobian(const Vector6d& tau) { return LeftJacobian(-tau); }

/// Jl⁻¹(tau) = [Ji  -Ji Q Ji; 0  Ji], with Ji = Jl⁻¹(theta) of SO(3) and Q the upper right block
/// of Jl(tau).
Matrix6d LeftJacobianInverse(const Vector6d& tau);

/// Jr⁻¹(tau) = Jl⁻¹(-tau).
inline Matrix6d RightJacobianInverse(const Vector6d& tau) { return LeftJacobianInverse(-tau); }

}  // namespace se3

/// T ⊕ tau = T Exp(tau).
inline SE3 Plus(const SE3& T, const Vector6d& tau) { return T * se3::Exp(tau); }

/// T1 ⊖ T2 = Log(T2⁻¹ T1).
inline Vector6d Minus(const SE3& T1, const SE3& T2) { return se3::Log(T2.Inverse() * T1); }

}  // namespace trajlo
