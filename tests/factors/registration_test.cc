// SPDX-License-Identifier: MIT
#include <ceres/autodiff_cost_function.h>
#include <ceres/crs_matrix.h>
#include <ceres/problem.h>

#include "factors/plane_distances.h"
#include "factors/point_to_plane.h"
#include "factors/segment_registration.h"
#include "tests/support/autodiff_twins.h"
#include "tests/support/factor_testing.h"
#include "tests/support/random_segment.h"

namespace trajlo {
namespace {

using testing::PointToPlaneTwin;
using testing::Random;
using testing::RandomPoint;
using testing::RandomSegment;
using testing::TangentJacobian;

TEST(PointToPlane, ValueAndJacobiansAreThoseOfAutodiffAtDelicateAnglesAndTimes) {
  Random random;
  for (int draw = 0; draw < 200; ++draw) {
    const auto angles = testing::DelicateAngles();
    const double angle = std::min(angles[draw % angles.size()], 3.1);
    const double alpha = draw % 5 == 0 ? 0.0 : draw % 5 == 1 ? 1.0 : random.Uniform(0, 1);
    const SE3 begin = random.Pose();
    const SE3 end = Plus(begin, random.Tangent(angle, 1.0));
    const RegistrationPoint point = RandomPoint(&random, alpha);
    const PointToPlaneCost factor(point, 0.1);
    const ceres::AutoDiffCostFunction<PointToPlaneTwin, 1, 7, 7> twin(
        new PointToPlaneTwin{point, 0.1});
    double value, expected;
    const double* blocks[2] = {begin.data(), end.data()};
    factor.Evaluate(blocks, &value, nullptr);
    twin.Evaluate(blocks, &expected, nullptr);
    EXPECT_NEAR(value, expected, 1e-9 * (1 + std::abs(expected)));
    for (int block = 0; block < 2; ++block) {
      const Eigen::MatrixXd J = TangentJacobian(factor, {begin, end}, block);
      const Eigen::MatrixXd J_twin = TangentJacobian(twin, {begin, end}, block);
      EXPECT_LT((J - J_twin).norm(), 1e-7 * (1 + J_twin.norm())) << angle << " " << alpha;
    }
  }
}

TEST(PointToPlane, PassesCeresGradientCheckerAndNullJacobianCalls) {
  Random random(2);
  const SE3 begin = random.Pose();
  const SE3 end = Plus(begin, random.Tangent(0.2, 0.5));
  const PointToPlaneCost factor(RandomPoint(&random, 0.4), 0.1);
  testing::ExpectJacobiansMatchNumericOnes(factor, {begin, end}, 1e-6);
  testing::ExpectNullJacobianFormsWork(factor, {begin, end});
}

/// Cost, gradient and Gauss-Newton Hessian of one PointToPlaneCost a point, summed by Ceres.
RegistrationNormalEquations SumOfPlainFactors(const std::vector<RegistrationPoint>& points,
                                              SE3 begin, SE3 end, const RegistrationNoise& noise) {
  SE3Manifold manifold;
  ceres::Problem::Options options;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  RobustKernelLoss losses[3] = {RobustKernelLoss(noise.KernelOf(0)),
                                RobustKernelLoss(noise.KernelOf(1)),
                                RobustKernelLoss(noise.KernelOf(2))};
  ceres::Problem problem(options);
  problem.AddParameterBlock(begin.data(), 7, &manifold);
  problem.AddParameterBlock(end.data(), 7, &manifold);
  for (const RegistrationPoint& point : points) {
    problem.AddResidualBlock(new PointToPlaneCost(point, noise.sigma_m), &losses[point.axis],
                             begin.data(), end.data());
  }
  RegistrationNormalEquations sum;
  std::vector<double> gradient;
  ceres::CRSMatrix jacobian;
  ceres::Problem::EvaluateOptions evaluate;
  evaluate.parameter_blocks = {begin.data(), end.data()};
  problem.Evaluate(evaluate, &sum.cost, nullptr, &gradient, &jacobian);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(jacobian.num_rows, 12);
  for (int row = 0; row < jacobian.num_rows; ++row) {
    for (int i = jacobian.rows[row]; i < jacobian.rows[row + 1]; ++i) {
      J(row, jacobian.cols[i]) = jacobian.values[i];
    }
  }
  sum.H = J.transpose() * J;
  sum.g = Eigen::Map<Vector12d>(gradient.data());
  return sum;
}

class SegmentRegistration : public ::testing::TestWithParam<KernelKind> {};

TEST_P(SegmentRegistration, EqualsOneFactorAPointInCostGradientAndHessian) {
  Random random(3);
  for (double angle : {0.0, 1e-9, 0.1, 0.9, 1.2, 2.8}) {
    const SE3 begin = random.Pose();
    const SE3 end = Plus(begin, random.Tangent(angle, 0.5));
    for (int count : {0, 1, 3, 4, 30, 257}) {
      const auto points = RandomSegment(&random, begin, end, count, 0.2);
      const RegistrationNoise noise{0.1, {GetParam(), 2.0}, {1.0, 2.0, 0.5}};
      const auto plain = SumOfPlainFactors(points, begin, end, noise);
      const auto condensed = LinearizeSegment(points, begin, end, noise);
      EXPECT_NEAR(condensed.cost, plain.cost, 1e-9 * (1 + plain.cost));
      EXPECT_LT((condensed.g - plain.g).norm(), 1e-9 * (1 + plain.g.norm())) << angle;
      EXPECT_LT((condensed.H - plain.H).norm(), 1e-9 * (1 + plain.H.norm())) << angle;

      // And what Ceres sees of the 13 rows.
      const SegmentRegistrationCost factor(&points, noise);
      Eigen::Matrix<double, 13, 12> J;
      J << TangentJacobian(factor, {begin, end}, 0), TangentJacobian(factor, {begin, end}, 1);
      Eigen::Matrix<double, 13, 1> r;
      std::vector<double> storage(2 * 13 * 7);
      double* jacobians[2] = {storage.data(), storage.data() + 13 * 7};
      const double* blocks[2] = {begin.data(), end.data()};
      ASSERT_TRUE(factor.Evaluate(blocks, r.data(), jacobians));
      EXPECT_NEAR(0.5 * r.squaredNorm(), plain.cost, 1e-9 * (1 + plain.cost));
      EXPECT_LT((J.transpose() * r - plain.g).norm(), 1e-9 * (1 + plain.g.norm()));
      EXPECT_LT((J.transpose() * J - plain.H).norm(), 1e-9 * (1 + plain.H.norm()));
      testing::ExpectNullJacobianFormsWork(factor, {begin, end}, testing::NullForms::kGiveTheCost);
    }
  }
}

TEST_P(SegmentRegistration, PointsThatShareAnErrorCountAsOne) {
  Random random(23);
  const SE3 begin = random.Pose();
  const SE3 end = Plus(begin, random.Tangent(0.5, 0.5));
  const auto points = RandomSegment(&random, begin, end, 50, 0.2);
  const RegistrationNoise noise{0.1, {GetParam(), 2.0}, {1.0, 2.0, 0.5}};
  const auto alone = LinearizeSegment(points, begin, end, noise);
  const auto shared = LinearizeSegment(points, begin, end, noise.SharedBy(7.0));
  EXPECT_NEAR(shared.cost, alone.cost / 7.0, 1e-12 * alone.cost);
  EXPECT_LT((shared.g - alone.g / 7.0).norm(), 1e-12 * alone.g.norm());
  EXPECT_LT((shared.H - alone.H / 7.0).norm(), 1e-12 * alone.H.norm());
}

INSTANTIATE_TEST_SUITE_P(Kernels, SegmentRegistration,
                         ::testing::Values(KernelKind::kNone, KernelKind::kHuber,
                                           KernelKind::kCauchy, KernelKind::kGemanMcClure,
                                           KernelKind::kTukey));

TEST(SegmentRegistration, GradientIsTheDerivativeOfTheRobustCost) {
  Random random(4);
  const SE3 begin = random.Pose();
  const SE3 end = Plus(begin, random.Tangent(0.3, 0.5));
  const auto points = RandomSegment(&random, begin, end, 100, 0.3);
  const RegistrationNoise noise{0.1, {KernelKind::kCauchy, 2.0}, {1.0, 2.0, 0.5}};
  const auto at = LinearizeSegment(points, begin, end, noise);
  const double h = 1e-6;
  for (int i = 0; i < 12; ++i) {
    const Vector6d d = h * Vector6d::Unit(i % 6);
    auto cost = [&](double sign) {
      const SE3 b = i < 6 ? Plus(begin, sign * d) : begin;
      const SE3 e = i < 6 ? end : Plus(end, sign * d);
      return LinearizeSegment(points, b, e, noise).cost;
    };
    EXPECT_NEAR(at.g[i], (cost(1) - cost(-1)) / (2 * h), 1e-4 * (1 + std::abs(at.g[i])));
  }
}

TEST(SegmentRegistration, CostAloneEqualsTheCostOfTheLinearization) {
  Random random(5);
  const SE3 begin = random.Pose();
  const SE3 end = Plus(begin, random.Tangent(0.3, 0.5));
  const auto points = RandomSegment(&random, begin, end, 61, 0.3);
  const RegistrationNoise noise{0.1, {KernelKind::kCauchy, 2.0}, {1.0, 2.0, 0.5}};
  const SegmentLinearizer linearizer(begin, end, noise);
  EXPECT_NEAR(linearizer.Cost(points.data(), points.size()),
              linearizer.Linearize(points.data(), points.size()).cost, 1e-9);
}

TEST(PlaneDistances, AreThoseOfEveryStridethPointInOrder) {
  Random random(6);
  const SE3 begin = random.Pose();
  const SE3 end = Plus(begin, random.Tangent(0.3, 0.5));
  const SegmentMotion motion(begin, end);
  for (const int count : {0, 1, 4, 61}) {
    const auto points = RandomSegment(&random, begin, end, count, 0.3);
    for (const std::size_t stride : {1u, 3u, 100u}) {
      std::size_t i = 0;
      ForEachDistance(points, motion, stride, [&](const RegistrationPoint& point, double r) {
        ASSERT_EQ(&point, &points.at(i));
        EXPECT_NEAR(r, point.DistanceToPlane(motion.ToWorld(point.alpha, point.p_body_m)), 1e-12);
        i += stride;
      });
      EXPECT_EQ(i, (points.size() + stride - 1) / stride * stride);
    }
  }
}

TEST(SegmentRegistration, AScanAtOneInstantOnlyConstrainsThatPose) {
  Random random(8);
  const SE3 begin = random.Pose();
  const SE3 end = Plus(begin, random.Tangent(0.1, 0.3));
  auto points = RandomSegment(&random, begin, end, 50, 0.1);
  for (auto& point : points) point.alpha = 1.0;
  const auto condensed = LinearizeSegment(points, begin, end, {0.1, {KernelKind::kNone, 1.0}});
  EXPECT_LT((condensed.H.topRows<6>().norm()), 1e-6);
  EXPECT_GT((condensed.H.bottomRightCorner<6, 6>().norm()), 1.0);
}

TEST(RobustKernel, IsTheLossOfCeresWhereCeresHasOne) {
  const double width = 1.7;
  const ceres::HuberLoss huber(width);
  const ceres::CauchyLoss cauchy(width);
  const ceres::TukeyLoss tukey(width);
  const std::pair<KernelKind, const ceres::LossFunction*> pairs[] = {
      {KernelKind::kHuber, &huber}, {KernelKind::kCauchy, &cauchy}, {KernelKind::kTukey, &tukey}};
  for (const auto& [kind, loss] : pairs) {
    for (double s : {0.0, 0.1, 2.0, 2.89, 3.0, 50.0}) {
      double expected[3];
      loss->Evaluate(s, expected);
      EXPECT_NEAR((RobustKernel{kind, width}.Rho(s)), expected[0], 1e-14);
      EXPECT_NEAR((RobustKernel{kind, width}.Weight(s)), expected[1], 1e-14);
    }
  }
}

TEST(RobustKernel, WeightIsTheDerivativeOfRho) {
  for (KernelKind kind : {KernelKind::kNone, KernelKind::kHuber, KernelKind::kCauchy,
                          KernelKind::kGemanMcClure, KernelKind::kTukey}) {
    const RobustKernel kernel{kind, 1.3};
    for (double s : {0.01, 0.5, 1.5, 4.0, 20.0}) {
      const double h = 1e-6;
      EXPECT_NEAR(kernel.Weight(s), (kernel.Rho(s + h) - kernel.Rho(s - h)) / (2 * h), 1e-8);
      EXPECT_LE(s * kernel.Weight(s), kernel.Rho(s) + 1e-15);
    }
  }
}

}  // namespace
}  // namespace trajlo
