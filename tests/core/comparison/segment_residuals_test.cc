// SPDX-License-Identifier: MIT
#include "core/comparison/forms/segment_residuals.h"

#include <gtest/gtest.h>

#include "tests/support/factor_testing.h"
#include "tests/support/random_segment.h"

namespace trajlo {
namespace {

using testing::Random;
using testing::RandomSegment;
using testing::TangentJacobian;

TEST(SegmentResidualsCost, PassesCeresGradientCheckerAndNullJacobianCalls) {
  Random random(10);
  const SE3 begin = random.Pose();
  const SE3 end = Plus(begin, random.Tangent(0.2, 0.5));
  const auto points = RandomSegment(&random, begin, end, 12, 0.2);
  // Wide kernels: numeric derivatives take steps of metres.
  for (KernelKind kind : {KernelKind::kNone, KernelKind::kCauchy, KernelKind::kGemanMcClure}) {
    const SegmentResidualsCost factor(&points, {0.1, {kind, 100.0}});
    testing::ExpectJacobiansMatchNumericOnes(factor, {begin, end}, 1e-5);
    testing::ExpectNullJacobianFormsWork(factor, {begin, end});
  }
}

class SegmentResiduals : public ::testing::TestWithParam<KernelKind> {};

TEST_P(SegmentResiduals, HasTheCostAndTheGradientOfTheCondensedForm) {
  Random random(11);
  const SE3 begin = random.Pose();
  const SE3 end = Plus(begin, random.Tangent(0.1, 0.3));
  const auto points = RandomSegment(&random, begin, end, 57, 0.2);
  const RegistrationNoise noise{0.1, {GetParam(), 2.0}, {1.0, 2.0, 0.5}};
  const SegmentResidualsCost factor(&points, noise);
  Eigen::MatrixXd J(57, 12);
  J << TangentJacobian(factor, {begin, end}, 0), TangentJacobian(factor, {begin, end}, 1);
  Eigen::VectorXd r(57);
  const double* blocks[2] = {begin.data(), end.data()};
  factor.Evaluate(blocks, r.data(), nullptr);
  const auto condensed = LinearizeSegment(points, begin, end, noise);
  EXPECT_NEAR(0.5 * r.squaredNorm(), condensed.cost, 1e-9 * (1.0 + condensed.cost));
  EXPECT_LT((J.transpose() * r - condensed.g).norm(), 1e-9 * (1.0 + condensed.g.norm()));
}

INSTANTIATE_TEST_SUITE_P(Kernels, SegmentResiduals,
                         ::testing::Values(KernelKind::kNone, KernelKind::kHuber,
                                           KernelKind::kCauchy, KernelKind::kGemanMcClure,
                                           KernelKind::kTukey));

}  // namespace
}  // namespace trajlo
