// SPDX-License-Identifier: MIT
#include "factors/marginalization_prior.h"

#include <ceres/autodiff_cost_function.h>

#include <Eigen/Dense>

#include "factors/segment_linearizer.h"
#include "tests/support/autodiff_twins.h"
#include "tests/support/factor_testing.h"
#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

using testing::PriorTwin;
using testing::Random;
using testing::TangentJacobian;

Eigen::MatrixXd RandomMatrix(Random* random, int rows, int columns) {
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return random->Gaussian(1.0); });
}

MarginalizationPrior RandomPrior(Random* random, int poses) {
  MarginalizationPrior prior;
  for (int i = 0; i < poses; ++i) prior.linearization_points.push_back(random->Pose());
  prior.sqrt_information = RandomMatrix(random, 6 * poses, 6 * poses);
  prior.offset = RandomMatrix(random, 6 * poses, 1);
  return prior;
}

/// H and b of the prior's quadratic.
Eigen::MatrixXd Information(const MarginalizationPrior& prior) {
  return prior.sqrt_information.transpose() * prior.sqrt_information;
}
Eigen::VectorXd Gradient(const MarginalizationPrior& prior) {
  return prior.sqrt_information.transpose() * prior.offset;
}

std::vector<SE3> NearThePrior(const MarginalizationPrior& prior, Random* random, double angle,
                              double distance_m) {
  std::vector<SE3> poses;
  for (const SE3& point : prior.linearization_points) {
    poses.push_back(Plus(point, random->Tangent(angle, distance_m)));
  }
  return poses;
}

TEST(MarginalizationPrior, ValueAndJacobianAreThoseOfAutodiff) {
  Random random;
  for (int draw = 0; draw < 200; ++draw) {
    const auto angles = testing::DelicateAngles();
    const MarginalizationPrior prior = RandomPrior(&random, 1);
    const std::vector<SE3> poses =
        NearThePrior(prior, &random, std::min(angles[draw % angles.size()], 3.1), 1.0);
    const MarginalizationPriorCost factor(&prior);
    const ceres::AutoDiffCostFunction<PriorTwin, 6, 7> twin(
        new PriorTwin{prior.linearization_points[0], prior.sqrt_information, prior.offset});
    const double* blocks[1] = {poses[0].data()};
    Vector6d value, expected;
    factor.Evaluate(blocks, value.data(), nullptr);
    twin.Evaluate(blocks, expected.data(), nullptr);
    EXPECT_LT((value - expected).norm(), 1e-8 * (1 + expected.norm()));
    const Eigen::MatrixXd expected_J = TangentJacobian(twin, poses, 0);
    EXPECT_LT((TangentJacobian(factor, poses, 0) - expected_J).norm(), 1e-6 * expected_J.norm());
  }
}

TEST(MarginalizationPrior, PassesCeresGradientCheckerAndNullJacobianCalls) {
  Random random(2);
  for (int poses : {1, 2}) {
    const MarginalizationPrior prior = RandomPrior(&random, poses);
    const MarginalizationPriorCost factor(&prior);
    const std::vector<SE3> at = NearThePrior(prior, &random, 0.3, 0.4);
    testing::ExpectJacobiansMatchNumericOnes(factor, at, 1e-6);
    testing::ExpectNullJacobianFormsWork(factor, at);
  }
}

TEST(MarginalizationPrior, FirstEstimateJacobianIsTheOneAtTheLinearizationPoint) {
  Random random(3);
  MarginalizationPrior prior = RandomPrior(&random, 2);
  const std::vector<SE3> poses = NearThePrior(prior, &random, 0.3, 0.4);
  EXPECT_TRUE(prior.Jacobian(prior.linearization_points).isApprox(prior.sqrt_information));
  EXPECT_FALSE(prior.Jacobian(poses).isApprox(prior.sqrt_information, 1e-3));
  const Eigen::VectorXd residual = prior.Residual(poses);
  prior.first_estimate_jacobians = true;
  EXPECT_EQ(prior.Jacobian(poses), prior.sqrt_information);
  EXPECT_EQ(prior.Residual(poses), residual);
}

/// The prior without ever forming H: QR of the stacked [J_l J_s | r], of which the rows below the
/// leaving pose remain (Demmel et al., Square Root Marginalization, 2021).
MarginalizationPrior MarginalizeQr(const Eigen::MatrixXd& J, const Eigen::VectorXd& r,
                                   const std::vector<SE3>& staying) {
  Eigen::MatrixXd stacked(J.rows(), J.cols() + 1);
  stacked << J, r;
  const Eigen::MatrixXd R = stacked.householderQr().matrixQR().triangularView<Eigen::Upper>();
  const Eigen::Index rest = J.cols() - 6;
  return {staying, R.block(6, 6, rest, rest), R.block(6, J.cols(), rest, 1)};
}

TEST(MarginalizationPrior, SchurAndQrAgree) {
  Random random(4);
  for (int draw = 0; draw < 50; ++draw) {
    const int poses = 1 + draw % 2;
    const Eigen::MatrixXd J = RandomMatrix(&random, 30, 6 + 6 * poses);
    const Eigen::VectorXd r = RandomMatrix(&random, 30, 1);
    std::vector<SE3> at;
    for (int i = 0; i < poses; ++i) at.push_back(random.Pose());
    const auto schur = MarginalizeSchur(J.transpose() * J, J.transpose() * r, at);
    const auto qr = MarginalizeQr(J, r, at);
    EXPECT_TRUE(Information(schur).isApprox(Information(qr), 1e-10));
    EXPECT_TRUE(Gradient(schur).isApprox(Gradient(qr), 1e-10));
  }
}

TEST(MarginalizationPrior, PoseByPoseOnALinearProblemEqualsTheFullBatch) {
  Random random(5);
  for (int draw = 0; draw < 20; ++draw) {
    // A chain x0..x5 of linear residuals between neighbours and an anchor on x0.
    constexpr int kPoses = 6;
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(6 * kPoses, 6 * kPoses);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(6 * kPoses);
    H.topLeftCorner<6, 6>().setIdentity();
    std::vector<Matrix12d> link_H;
    std::vector<Vector12d> link_g;
    for (int k = 0; k + 1 < kPoses; ++k) {
      const Eigen::MatrixXd J = RandomMatrix(&random, 20, 12);
      const Eigen::VectorXd r = RandomMatrix(&random, 20, 1);
      link_H.emplace_back(J.transpose() * J);
      link_g.emplace_back(J.transpose() * r);
      H.block<12, 12>(6 * k, 6 * k) += link_H.back();
      g.segment<12>(6 * k) += link_g.back();
    }
    const Eigen::VectorXd batch = -H.ldlt().solve(g);

    MarginalizationPrior prior = MakeAnchor(SE3(), 1.0, 1.0);
    for (int k = 0; k + 1 < kPoses; ++k) {
      Matrix12d H_local = link_H[k];
      Vector12d g_local = link_g[k];
      H_local.topLeftCorner<6, 6>() += Information(prior);
      g_local.head<6>() += Gradient(prior);
      prior = MarginalizeSchur(H_local, g_local, {SE3()});
    }
    const Vector6d last = -Information(prior).ldlt().solve(Gradient(prior));
    EXPECT_LT((last - batch.tail<6>()).norm(), 1e-10);
    // The covariance of the last pose is that of the full batch, too.
    const Matrix6d covariance = H.inverse().bottomRightCorner<6, 6>();
    EXPECT_TRUE(Information(prior).inverse().isApprox(covariance, 1e-9));
  }
}

TEST(MarginalizationPrior, DirectionsThatNobodyMeasuredStayFree) {
  // Only a relative measurement between the two poses, along five of six directions.
  Matrix12d H = Matrix12d::Zero();
  for (int i = 0; i < 5; ++i) {
    H(i, i) = H(6 + i, 6 + i) = 1.0;
    H(i, 6 + i) = H(6 + i, i) = -1.0;
  }
  const auto prior = MarginalizeSchur(H, Vector12d::Zero(), {SE3()});
  EXPECT_LT(Information(prior).norm(), 1e-12) << "a relative measurement must not anchor a pose";
  // With an anchor on the leaving pose, exactly the five measured directions are held.
  H.topLeftCorner<6, 6>() += Matrix6d::Identity();
  const Matrix6d information = Information(MarginalizeSchur(H, Vector12d::Zero(), {SE3()}));
  EXPECT_NEAR(information(5, 5), 0.0, 1e-12);
  EXPECT_NEAR(information(0, 0), 0.5, 1e-12);
}

TEST(MarginalizationPrior, TheLinearTermPullsToTheMinimumOfWhatWasEliminated) {
  // ½|x_l - a|² + ½|x_s - x_l - b|² has its minimum over x_l at ½·½|x_s - a - b|².
  Matrix12d H = Matrix12d::Zero();
  H.topLeftCorner<6, 6>() = 2.0 * Matrix6d::Identity();
  H.bottomRightCorner<6, 6>().setIdentity();
  H.topRightCorner<6, 6>() = H.bottomLeftCorner<6, 6>() = -Matrix6d::Identity();
  const Vector6d a = Vector6d::Constant(0.3), b = Vector6d::LinSpaced(0.1, 0.6);
  Vector12d g;
  g << -a + b, -b;
  const auto prior = MarginalizeSchur(H, g, {SE3()});
  const Vector6d minimum = -Information(prior).ldlt().solve(Gradient(prior));
  EXPECT_LT((minimum - (a + b)).norm(), 1e-12);
}

TEST(MarginalizationPrior, AnAnchorIsWhatItsSigmasSay) {
  const auto anchor = MakeAnchor(SE3(), 0.5, 0.1);
  Vector6d tau = Vector6d::Zero();
  tau << 0.5, 0, 0, 0, 0, 0.1;
  EXPECT_NEAR(anchor.Residual({se3::Exp(tau)}).squaredNorm(), 2.0, 1e-2);
}

}  // namespace
}  // namespace trajlo
