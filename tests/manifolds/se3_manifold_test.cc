// SPDX-License-Identifier: MIT
#include "manifolds/se3_manifold.h"

#include <ceres/manifold_test_utils.h>
#include <gtest/gtest.h>

#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

using namespace ceres;  // NOLINT: the macro of manifold_test_utils.h names its helpers unqualified.

constexpr double kTolerance = 1e-9;

TEST(SE3Manifold, HoldsTheInvariantsOfACeresManifold) {
  const SE3Manifold manifold;
  trajlo::testing::Random random;
  for (double angle : {0.0, 1e-9, 1e-3, 1.0, 2.5, M_PI - 1e-3}) {
    for (int trial = 0; trial < 30; ++trial) {
      const SE3 X = random.Pose();
      const Vector6d tau = random.Tangent(angle, random.Uniform(0, 3));
      const SE3 Y = Plus(X, tau);
      const Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(X.data(), 7);
      const Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(Y.data(), 7);
      const Eigen::VectorXd delta = tau;
      EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, delta, y, kTolerance);
    }
  }
}

TEST(SE3Manifold, TurnsTangentJacobiansIntoAmbientOnesAndBackExactly) {
  trajlo::testing::Random random(3);
  for (int i = 0; i < 20; ++i) {
    const SE3 T = random.Pose();
    EXPECT_TRUE((Se3MinusJacobian(T) * Se3PlusJacobian(T)).isIdentity(1e-14));
  }
}

}  // namespace
}  // namespace trajlo
