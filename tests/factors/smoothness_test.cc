// SPDX-License-Identifier: MIT
#include "factors/smoothness.h"

#include <ceres/autodiff_cost_function.h>

#include "tests/support/autodiff_twins.h"
#include "tests/support/factor_testing.h"
#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

using testing::Random;
using testing::SmoothnessTwin;
using testing::TangentJacobian;

SmoothnessTerm RandomTerm(Random* random) {
  SmoothnessTerm term;
  term.tau_expected = random->Tangent(0.3, 0.5);
  term.sqrt_information << 20, 20, 20, 35, 35, 35;
  return term;
}

TEST(Smoothness, ValueAndJacobiansAreThoseOfAutodiff) {
  Random random;
  for (int draw = 0; draw < 200; ++draw) {
    const auto angles = testing::DelicateAngles();
    const SE3 begin = random.Pose();
    const SE3 end = Plus(begin, random.Tangent(std::min(angles[draw % angles.size()], 3.1), 1.0));
    const SmoothnessTerm term = RandomTerm(&random);
    const SmoothnessCost factor(&term);
    const ceres::AutoDiffCostFunction<SmoothnessTwin, 6, 7, 7> twin(
        new SmoothnessTwin{term.tau_expected, term.sqrt_information});
    const double* blocks[2] = {begin.data(), end.data()};
    Vector6d value, expected;
    factor.Evaluate(blocks, value.data(), nullptr);
    twin.Evaluate(blocks, expected.data(), nullptr);
    EXPECT_LT((value - expected).norm(), 1e-8 * (1 + expected.norm()));
    for (int block = 0; block < 2; ++block) {
      const Eigen::MatrixXd expected_J = TangentJacobian(twin, {begin, end}, block);
      EXPECT_LT((TangentJacobian(factor, {begin, end}, block) - expected_J).norm(),
                1e-6 * expected_J.norm());
    }
  }
}

TEST(Smoothness, PassesCeresGradientCheckerAndNullJacobianCalls) {
  Random random(2);
  const SE3 begin = random.Pose();
  const SE3 end = Plus(begin, random.Tangent(0.2, 0.5));
  const SmoothnessTerm term = RandomTerm(&random);
  const SmoothnessCost factor(&term);
  testing::ExpectJacobiansMatchNumericOnes(factor, {begin, end}, 1e-6);
  testing::ExpectNullJacobianFormsWork(factor, {begin, end});
}

TEST(Smoothness, IsZeroWhenTheVelocityIsKept) {
  Random random(3);
  const SE3 begin = random.Pose();
  SmoothnessTerm term = RandomTerm(&random);
  EXPECT_LT(term.Residual(begin, Plus(begin, term.tau_expected)).norm(), 1e-12);
}

}  // namespace
}  // namespace trajlo
