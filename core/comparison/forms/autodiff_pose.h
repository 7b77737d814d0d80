// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/rotation.h>

#include <Eigen/Core>
#include <cmath>

#include "manifolds/eigen_abi.h"

/// Poses for automatic differentiation (T: double or ceres::Jet), written from the textbook
/// formulas and from Ceres's own rotation functions. They share nothing with the analytic code, so
/// tests hold that against them; and a study can measure what analytic Jacobians are worth.
namespace trajlo::autodiff {

template <typename T>
using Vec3 = Eigen::Matrix<T, 3, 1>;
template <typename T>
using Vec6 = Eigen::Matrix<T, 6, 1>;

/// V(theta) rho, or its inverse, by the closed forms with a series near 0.
template <typename T>
Vec3<T> ApplyV(const Vec3<T>& theta, const Vec3<T>& rho, bool inverse) {
  const T s = theta.squaredNorm();
  T a, b;
  if (s > T(1e-4)) {
    const T x = sqrt(s);
    a = (T(1) - cos(x)) / s;
    b = (x - sin(x)) / (s * x);
    if (inverse) {
      a = T(-0.5);
      b = (T(1) - x * sin(x) / (T(2) * (T(1) - cos(x)))) / s;
    }
  } else {
    a = inverse ? T(-0.5) : T(0.5) - s / 24.0 + s * s / 720.0;
    b = inverse ? T(1.0 / 12) + s / 720.0 + s * s / 30240.0
                : T(1.0 / 6) - s / 120.0 + s * s / 5040.0;
  }
  const Vec3<T> c = theta.cross(rho);
  return rho + a * c + b * theta.cross(c);
}

template <typename T>
struct Pose {
  T q[4];  // w x y z, as ceres/rotation.h wants it
  Vec3<T> t;

  static Pose FromBlock(const T* x) { return {{x[3], x[0], x[1], x[2]}, {x[4], x[5], x[6]}}; }
  Vec3<T> Rotate(const Vec3<T>& v) const {
    Vec3<T> out;
    ceres::QuaternionRotatePoint(q, v.data(), out.data());
    return out;
  }
  Vec3<T> operator*(const Vec3<T>& v) const { return Rotate(v) + t; }
  Pose Inverse() const {
    Pose out{{q[0], -q[1], -q[2], -q[3]}, {}};
    out.t = -out.Rotate(t);
    return out;
  }
  Pose operator*(const Pose& other) const {
    Pose out;
    ceres::QuaternionProduct(q, other.q, out.q);
    out.t = Rotate(other.t) + t;
    return out;
  }
  static Pose Exp(const Vec6<T>& tau) {
    const Vec3<T> theta = tau.template tail<3>();
    Pose out;
    ceres::AngleAxisToQuaternion(theta.data(), out.q);
    out.t = ApplyV<T>(theta, tau.template head<3>(), false);
    return out;
  }
  Vec6<T> Log() const {
    Vec3<T> theta;
    ceres::QuaternionToAngleAxis(q, theta.data());
    Vec6<T> tau;
    tau << ApplyV<T>(theta, t, true), theta;
    return tau;
  }
};

}  // namespace trajlo::autodiff
