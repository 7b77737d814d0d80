// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <unsupported/Eigen/MatrixFunctions>

#include "manifolds/se3.h"
#include "manifolds/se3_interpolation.h"
#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

using testing::DelicateAngles;
using testing::Random;

Eigen::Matrix4d ToMatrix(const SE3& T) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = T.q.toRotationMatrix();
  m.topRightCorner<3, 1>() = T.t;
  return m;
}

/// The defining series sum_n ad^n / (n+1)!, summed until it no longer changes.
template <typename Matrix>
Matrix JacobianSeries(const Matrix& ad) {
  Matrix term = Matrix::Identity();
  Matrix sum = term;
  for (int n = 1; n < 80; ++n) {
    term = term * ad / (n + 1.0);
    sum += term;
  }
  return sum;
}

TEST(Stumpff, MeetsItsSeriesAtAnyAngle) {
  for (double x : {0.0, 1e-9, 0.1, 0.5, 0.99, 1.01, 2.0, 3.14159, 6.0}) {
    const Stumpff c(x * x);
    const double values[6] = {c.c0, c.c1, c.c2, c.c3, c.c4, c.c5};
    for (int n = 0; n < 6; ++n) {
      long double term = 1.0L / std::tgamma(n + 1.0L);
      long double sum = term;
      for (int k = 1; k < 60; ++k) {
        term *= -static_cast<long double>(x) * x / ((2 * k + n - 1.0L) * (2 * k + n));
        sum += term;
      }
      EXPECT_NEAR(values[n], static_cast<double>(sum), 3e-16) << "c" << n << " at " << x;
    }
  }
}

TEST(SO3, ExpIsTheMatrixExponentialAndLogUndoesIt) {
  Random random;
  for (double angle : DelicateAngles()) {
    for (int i = 0; i < 20; ++i) {
      const Eigen::Vector3d theta = angle * random.Direction();
      const Eigen::Matrix3d expected = so3::Hat(theta).exp();
      EXPECT_TRUE(so3::Exp(theta).toRotationMatrix().isApprox(expected, 1e-14));
      EXPECT_LT((so3::Log(so3::Exp(theta)) - theta).norm(), 1e-14 + 1e-7 * (angle > 3.141592))
          << angle;
    }
  }
}

TEST(SO3, LogIsTheSameForBothQuaternionsOfARotation) {
  const Eigen::Quaterniond q = so3::Exp({0.3, -2.0, 0.9});
  const Eigen::Quaterniond negated(-q.w(), -q.x(), -q.y(), -q.z());
  EXPECT_LT((so3::Log(q) - so3::Log(negated)).norm(), 1e-15);
  EXPECT_NEAR(so3::Log(Eigen::Quaterniond(0, 1, 0, 0)).norm(), M_PI, 1e-15);
}

TEST(SO3, TheInverseJacobianIsTheInverseOfTheSeries) {
  Random random(2);
  for (double angle : DelicateAngles()) {
    const Eigen::Vector3d theta = angle * random.Direction();
    const auto jacobian = JacobianSeries<Eigen::Matrix3d>(so3::Hat(theta));
    EXPECT_TRUE((so3::LeftJacobianInverse(theta) * jacobian).isIdentity(1e-13));
  }
}

TEST(SE3, ExpIsTheMatrixExponentialAndLogUndoesIt) {
  Random random(3);
  for (double angle : DelicateAngles()) {
    const Vector6d tau = random.Tangent(angle, 3.0);
    Eigen::Matrix4d hat = Eigen::Matrix4d::Zero();
    hat.topLeftCorner<3, 3>() = so3::Hat(tau.tail<3>());
    hat.topRightCorner<3, 1>() = tau.head<3>();
    EXPECT_TRUE(ToMatrix(se3::Exp(tau)).isApprox(hat.exp(), 1e-14));
    EXPECT_LT((se3::Log(se3::Exp(tau)) - tau).norm(), 1e-13 + 1e-6 * (angle > 3.141592)) << angle;
  }
}

TEST(SE3, GroupOperationsAreThoseOfMatrices) {
  Random random(4);
  const SE3 A = random.Pose(), B = random.Pose();
  EXPECT_TRUE(ToMatrix(A * B).isApprox(ToMatrix(A) * ToMatrix(B), 1e-14));
  EXPECT_TRUE(ToMatrix(A.Inverse()).isApprox(ToMatrix(A).inverse(), 1e-14));
}

TEST(SE3, AdjointMovesATangentAcrossAPose) {
  Random random(5);
  for (int i = 0; i < 50; ++i) {
    const SE3 T = random.Pose();
    const Vector6d tau = random.Tangent(0.7, 0.5);
    EXPECT_TRUE(
        ToMatrix(T * se3::Exp(tau)).isApprox(ToMatrix(se3::Exp(se3::Adjoint(T) * tau) * T), 1e-13));
  }
}

TEST(SE3, JacobiansMeetTheirSeriesAndTheirInverses) {
  Random random(6);
  for (double angle : DelicateAngles()) {
    const Vector6d tau = random.Tangent(angle, 2.0);
    const Matrix6d left = se3::LeftJacobian(tau);
    EXPECT_TRUE(left.isApprox(JacobianSeries<Matrix6d>(se3::AdjointAlgebra(tau)), 1e-14)) << angle;
    EXPECT_TRUE((se3::LeftJacobianInverse(tau) * left).isIdentity(1e-12)) << angle;
    EXPECT_TRUE((se3::RightJacobianInverse(tau) * se3::RightJacobian(tau)).isIdentity(1e-12))
        << angle;
    EXPECT_TRUE(left.isApprox(se3::Adjoint(se3::Exp(tau)) * se3::RightJacobian(tau), 1e-13));
  }
}

TEST(SE3, RightJacobianIsTheDerivativeOfExp) {
  Random random(7);
  const double h = 1e-6;
  for (double angle : {0.0, 1e-9, 0.5, 2.5}) {
    const Vector6d tau = random.Tangent(angle, 2.0);
    Matrix6d numeric;
    for (int i = 0; i < 6; ++i) {
      const Vector6d step = h * Vector6d::Unit(i);
      numeric.col(i) = (Minus(se3::Exp(tau + step), se3::Exp(tau)) -
                        Minus(se3::Exp(tau - step), se3::Exp(tau))) /
                       (2 * h);
    }
    EXPECT_LT((numeric - se3::RightJacobian(tau)).norm(), 1e-8) << angle;
  }
}

TEST(Interpolation, MeetsItsEndsAndMovesWithConstantTwist) {
  Random random(8);
  const SE3 begin = random.Pose();
  const SE3 end = Plus(begin, random.Tangent(0.8, 1.0));
  EXPECT_LT(Minus(Interpolate(begin, end, 0.0), begin).norm(), 1e-14);
  EXPECT_LT(Minus(Interpolate(begin, end, 1.0), end).norm(), 1e-14);
  const SE3 quarter = Interpolate(begin, end, 0.25);
  EXPECT_LT(Minus(Interpolate(quarter, end, 1.0 / 3), Interpolate(begin, end, 0.5)).norm(), 1e-14);
}

TEST(Interpolation, OfPointsIsThatOfPoses) {
  Random random(10);
  for (double angle : DelicateAngles()) {
    const SE3 begin = random.Pose();
    const SE3 end = Plus(begin, random.Tangent(std::min(angle, 3.1), 1.0));
    const SegmentMotion motion(begin, end);
    for (double alpha : {0.0, 0.2, 0.7, 1.0}) {
      const Eigen::Vector3d p = 50.0 * random.Direction();
      EXPECT_LT((motion.ToWorld(alpha, p) - Interpolate(begin, end, alpha) * p).norm(), 1e-12);
    }
  }
}

TEST(Interpolation, JacobiansAreTheDerivatives) {
  Random random(9);
  const double h = 1e-6;
  for (double alpha : {0.0, 0.3, 1.0}) {
    for (double angle : {0.0, 1e-9, 0.4, 2.0}) {
      const SE3 begin = random.Pose();
      const Vector6d tau = random.Tangent(angle, 1.0);
      const SE3 end = Plus(begin, tau);
      const SE3 at = Interpolate(begin, end, alpha);
      const InterpolationJacobians J = InterpolateJacobians(tau, alpha);
      for (int i = 0; i < 6; ++i) {
        const Vector6d d = h * Vector6d::Unit(i);
        const Vector6d wrt_begin = (Minus(Interpolate(Plus(begin, d), end, alpha), at) -
                                    Minus(Interpolate(Plus(begin, -d), end, alpha), at)) /
                                   (2 * h);
        const Vector6d wrt_end = (Minus(Interpolate(begin, Plus(end, d), alpha), at) -
                                  Minus(Interpolate(begin, Plus(end, -d), alpha), at)) /
                                 (2 * h);
        EXPECT_LT((J.wrt_begin.col(i) - wrt_begin).norm(), 1e-8);
        EXPECT_LT((J.wrt_end.col(i) - wrt_end).norm(), 1e-8);
      }
    }
  }
}

}  // namespace
}  // namespace trajlo
