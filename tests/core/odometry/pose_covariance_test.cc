// SPDX-License-Identifier: MIT
// Covariances of poses that the odometry hands out.
#include <Eigen/Eigenvalues>

#include "tests/core/odometry/run_odometry.h"

namespace trajlo::testing {
namespace {

TEST(Odometry, HandsOutACovarianceForEveryPose) {
  SyntheticWorld world;
  world.T_world_body = StartsAtRest;
  OdometryOptions options = RoomOptions();
  Odometry odometry(options);
  std::vector<Matrix6d> covariances;
  odometry.OnPose([&](const ControlPose&, const Matrix6d& C) { covariances.push_back(C); });
  for (int i = 0; i < 10; ++i) odometry.AddScan(world.Sweep(i));
  odometry.Finish();
  ASSERT_EQ(covariances.size(), odometry.trajectory().poses().size());
  EXPECT_EQ(covariances.front(), Matrix6d::Zero());  // It defines the world.
  for (std::size_t i = 1; i < covariances.size(); ++i) {
    EXPECT_EQ(covariances[i], covariances[i].transpose());
    const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(covariances[i]);
    EXPECT_GT(eigen.eigenvalues()[0], 0.0);
    EXPECT_LT(std::sqrt(eigen.eigenvalues()[5]), 0.1);
  }
}

/// The mean of e' C^-1 e / 6 over poses a second apart, from 1.5 s on: see check_covariance.py.
double NormalisedErrorOfRelativePoses(const SyntheticWorld& world, int sweeps) {
  Odometry odometry(RoomOptions());
  std::vector<ControlPose> poses;
  std::vector<Matrix6d> covariances;
  odometry.OnPose([&](const ControlPose& pose, const Matrix6d& C) {
    poses.push_back(pose);
    covariances.push_back(C);
  });
  for (int i = 0; i < sweeps; ++i) odometry.AddScan(world.Sweep(i));
  odometry.Finish();
  const auto truth = [&](std::int64_t t_ns) {
    return world.T_world_body(1e-9 * static_cast<double>(t_ns - world.start_ns));
  };
  double sum = 0.0;
  int count = 0;
  for (std::size_t a = 1, b = 1; b < poses.size(); ++b) {
    while (poses[b].t_ns - poses[a + 1].t_ns >= 1'000'000'000) ++a;
    if (poses[b].t_ns - world.start_ns < 1'500'000'000) continue;
    if (poses[b].t_ns - world.start_ns > sweeps * 100'000'000LL - 100'000'000) break;
    const SE3 estimated = poses[a].T_world_body.Inverse() * poses[b].T_world_body;
    const SE3 expected = truth(poses[a].t_ns).Inverse() * truth(poses[b].t_ns);
    const Vector6d e = Minus(expected, estimated);
    const Matrix6d Ad = se3::Adjoint(estimated.Inverse());
    const Matrix6d C = covariances[b] + Ad * covariances[a] * Ad.transpose();
    sum += e.dot(C.ldlt().solve(e)) / 6.0;
    ++count;
  }
  return sum / count;
}

TEST(Odometry, CovariancesAreThoseOfRelativePosesAtRestAndInMotion) {
  SyntheticWorld world;
  // Without calibration it is 0.01 to 0.03 at rest. One run of three seconds tells no more than
  // the order of magnitude.
  const double at_rest = NormalisedErrorOfRelativePoses(world, 30);
  EXPECT_GT(at_rest, 0.1);
  EXPECT_LT(at_rest, 5.0);
  world.T_world_body = StartsAtRest;
  const double in_motion = NormalisedErrorOfRelativePoses(world, 30);
  EXPECT_GT(in_motion, 0.1);
  EXPECT_LT(in_motion, 5.0);
}

}  // namespace
}  // namespace trajlo::testing
