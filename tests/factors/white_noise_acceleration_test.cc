// SPDX-License-Identifier: MIT
#include "factors/white_noise_acceleration.h"

#include <ceres/autodiff_cost_function.h>

#include "tests/support/autodiff_twins.h"
#include "tests/support/factor_testing.h"
#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

using testing::Random;
using testing::TangentJacobian;
using testing::WhiteNoiseAccelerationTwin;

Vector6d Densities() {
  Vector6d density;
  density << 0.5, 0.5, 2.0, 0.3, 0.3, 0.8;
  return density;
}

TEST(WhiteNoiseAcceleration, ValueAndJacobiansAreThoseOfAutodiff) {
  Random random;
  for (int draw = 0; draw < 200; ++draw) {
    const auto angles = testing::DelicateAngles();
    const double angle = std::min(angles[draw % angles.size()], 3.1);
    std::vector<SE3> poses = {random.Pose()};
    poses.push_back(Plus(poses[0], random.Tangent(angle, 1.0)));
    poses.push_back(Plus(poses[1], random.Tangent(std::min(2.0 * angle, 3.1), 0.5)));
    WhiteNoiseAccelerationTerm term(Densities(), 0.03, draw % 2 == 0 ? 0.03 : 0.1);
    if (draw % 3 > 0) {
      term.persistence << 0.9, 0.8, 0.7, 1.0, 0.6, 0.5;
      term.mean_velocity = random.Tangent(0.5, 2.0);
    }
    const WhiteNoiseAccelerationCost factor(&term);
    const ceres::AutoDiffCostFunction<WhiteNoiseAccelerationTwin, 6, 7, 7, 7> twin(
        new WhiteNoiseAccelerationTwin{term});
    const double* blocks[3] = {poses[0].data(), poses[1].data(), poses[2].data()};
    Vector6d value, expected;
    factor.Evaluate(blocks, value.data(), nullptr);
    twin.Evaluate(blocks, expected.data(), nullptr);
    EXPECT_LT((value - expected).norm(), 1e-8 * (1 + expected.norm()));
    for (int block = 0; block < 3; ++block) {
      const Eigen::MatrixXd J = TangentJacobian(twin, poses, block);
      EXPECT_LT((TangentJacobian(factor, poses, block) - J).norm(), 1e-6 * J.norm()) << angle;
    }
  }
}

TEST(WhiteNoiseAcceleration, PassesCeresGradientCheckerAndNullJacobianCalls) {
  Random random(2);
  const SE3 T_0 = random.Pose();
  const SE3 T_1 = Plus(T_0, random.Tangent(0.2, 0.5));
  const SE3 T_2 = Plus(T_1, random.Tangent(0.3, 0.4));
  const WhiteNoiseAccelerationTerm term(Densities(), 0.4, 0.7);
  const WhiteNoiseAccelerationCost factor(&term);
  testing::ExpectJacobiansMatchNumericOnes(factor, {T_0, T_1, T_2}, 1e-6);
  testing::ExpectNullJacobianFormsWork(factor, {T_0, T_1, T_2});
}

TEST(WhiteNoiseAcceleration, IsZeroAtConstantVelocityWhateverTheIntervals) {
  Random random(3);
  const Vector6d twist = random.Tangent(0.4, 2.0);
  const SE3 T_0 = random.Pose();
  const SE3 T_1 = Plus(T_0, 0.03 * twist);
  const SE3 T_2 = Plus(T_1, 0.11 * twist);
  EXPECT_LT(WhiteNoiseAccelerationTerm(Densities(), 0.03, 0.11).Residual(T_0, T_1, T_2).norm(),
            1e-9);
}

TEST(WhiteNoiseAcceleration, IsZeroForAVelocityThatReturnsToItsMean) {
  WhiteNoiseAccelerationTerm term(Densities(), 0.03, 0.05);
  term.persistence.setConstant(0.25);
  term.mean_velocity << 1.0, 2.0, 3.0, 0.0, 0.0, 0.0;
  Vector6d velocity;
  velocity << 5.0, 2.0, -1.0, 0.4, 0.0, 0.0;
  Vector6d later;
  later << 2.0, 2.0, 2.0, 0.1, 0.0, 0.0;
  const SE3 T_0 = Random(5).Pose();
  const SE3 T_1 = Plus(T_0, 0.03 * velocity);
  const SE3 T_2 = Plus(T_1, 0.05 * later);
  EXPECT_LT(term.Residual(T_0, T_1, T_2).norm(), 1e-9 * term.sqrt_information.norm());
}

/// The formula q (dt_1 + dt_2) / 3 against sampled Wiener velocities.
TEST(WhiteNoiseAcceleration, TheVarianceIsThatOfMeanVelocitiesUnderWhiteAcceleration) {
  Random random(4);
  const double q = 0.7, fine_s = 1e-3;
  for (const auto& [first, second] : {std::pair(30, 30), std::pair(30, 100)}) {
    double squares = 0.0;
    constexpr int kDraws = 4000;
    for (int draw = 0; draw < kDraws; ++draw) {
      double velocity = 0.0, mean_first = 0.0, mean_second = 0.0;
      for (int i = 0; i < first + second; ++i) {
        velocity += random.Gaussian(std::sqrt(q * fine_s));
        (i < first ? mean_first : mean_second) += velocity / (i < first ? first : second);
      }
      squares += (mean_second - mean_first) * (mean_second - mean_first);
    }
    const WhiteNoiseAccelerationTerm term(Vector6d::Constant(q), first * fine_s, second * fine_s);
    const double variance = 1.0 / (term.sqrt_information[0] * term.sqrt_information[0]);
    EXPECT_NEAR(squares / kDraws / variance, 1.0, 0.1);
  }
}

}  // namespace
}  // namespace trajlo
