// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/manifold.h>

#include "manifolds/se3.h"

namespace trajlo {

/// d(T ⊕ tau)/d(tau) at tau = 0, in the ambient coordinates [qx qy qz qw tx ty tz].
inline Eigen::Matrix<double, 7, 6, Eigen::RowMajor> Se3PlusJacobian(const SE3& T) {
  Eigen::Matrix<double, 7, 6, Eigen::RowMajor> J = Eigen::Matrix<double, 7, 6>::Zero();
  // q ⊗ [theta/2, 1]: the vector part is (w I + [v]x) theta / 2, the scalar part -v·theta / 2.
  J.block<3, 3>(0, 3) = 0.5 * (T.q.w() * Eigen::Matrix3d::Identity() + so3::Hat(T.q.vec()));
  J.block<1, 3>(3, 3) = -0.5 * T.q.vec().transpose();
  J.block<3, 3>(4, 0) = T.q.toRotationMatrix();
  return J;
}

/// d(Y ⊖ T)/dY at Y = T; Se3MinusJacobian(T) * Se3PlusJacobian(T) = I.
inline Eigen::Matrix<double, 6, 7, Eigen::RowMajor> Se3MinusJacobian(const SE3& T) {
  Eigen::Matrix<double, 6, 7, Eigen::RowMajor> J = Eigen::Matrix<double, 6, 7>::Zero();
  J.block<3, 3>(3, 0) = 2.0 * (T.q.w() * Eigen::Matrix3d::Identity() - so3::Hat(T.q.vec()));
  J.block<3, 1>(3, 3) = -2.0 * T.q.vec();
  J.block<3, 3>(0, 4) = T.q.toRotationMatrix().transpose();
  return J;
}

/// What a factor gives Ceres: of each pose whose Jacobian is asked for, the 6 columns of `tangent`
/// that are its own, turned into Ceres's 7.
template <typename Tangent>
void WriteJacobians(const SE3* poses, const Eigen::MatrixBase<Tangent>& tangent,
                    double** jacobians) {
  using Ambient = Eigen::Matrix<double, Tangent::RowsAtCompileTime, 7, Eigen::RowMajor>;
  for (Eigen::Index i = 0; 6 * i < tangent.cols(); ++i) {
    if (jacobians[i] == nullptr) continue;
    Eigen::Map<Ambient> J(jacobians[i], tangent.rows(), 7);
    J.noalias() = tangent.template middleCols<6>(6 * i) * Se3MinusJacobian(poses[i]);
  }
}

/// SE(3) as a Ceres manifold: 7 ambient coordinates [qx qy qz qw tx ty tz], 6 tangent coordinates
/// [rho; theta], Plus(x, tau) = x Exp(tau), Minus(y, x) = Log(x⁻¹ y).
class SE3Manifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }

  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    const SE3 T = trajlo::Plus(SE3::FromData(x), Eigen::Map<const Vector6d>(delta));
    Eigen::Map<Eigen::Matrix<double, 7, 1>>(x_plus_delta) << T.q.coeffs(), T.t;
    return true;
  }

  bool PlusJacobian(const double* x, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> J(jacobian);
    J = Se3PlusJacobian(SE3::FromData(x));
    return true;
  }

  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    const SE3 Y = SE3::FromData(y);
    const SE3 X = SE3::FromData(x);
    // Not normalised: Minus stays the function of the ambient y that MinusJacobian differentiates.
    const SE3 difference(X.q.conjugate() * Y.q, X.q.conjugate() * (Y.t - X.t));
    Eigen::Map<Vector6d> result(y_minus_x);
    result = se3::Log(difference);
    return true;
  }

  bool MinusJacobian(const double* x, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> J(jacobian);
    J = Se3MinusJacobian(SE3::FromData(x));
    return true;
  }
};

}  // namespace trajlo
