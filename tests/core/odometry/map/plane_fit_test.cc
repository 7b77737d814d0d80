// SPDX-License-Identifier: MIT
#include "core/odometry/map/plane_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

/// Eight points of a random plane patch of the given half sizes and thickness.
Neighbors Patch(testing::Random* random, const Eigen::Vector3d& normal,
                const Eigen::Vector3d& center, double length, double width, double thickness) {
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  Neighbors neighbors;
  neighbors.origin_world = center;
  neighbors.count = 8;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d p = random->Uniform(-length, length) * u +
                              random->Uniform(-width, width) * v +
                              random->Gaussian(thickness) * normal;
    neighbors.x[i] = static_cast<float>(p.x());
    neighbors.y[i] = static_cast<float>(p.y());
    neighbors.z[i] = static_cast<float>(p.z());
    neighbors.squared_distance[i] = static_cast<float>(p.squaredNorm());
  }
  return neighbors;
}

TEST(PlaneFit, FindsThePlaneOfANoiselessPatchAnywhereInTheWorld) {
  testing::Random random;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d normal = random.Direction();
    const Eigen::Vector3d center = 1e5 * random.Direction();
    const Eigen::Vector3d asked_at = center + 0.2 * random.Direction();
    const FittedPlane plane =
        FitPlane(Patch(&random, normal, center, 0.5, 0.5, 0.0), asked_at, {}, 0.1);
    ASSERT_TRUE(plane.exists());
    EXPECT_NEAR(std::abs(plane.normal_world.cast<double>().dot(normal)), 1.0, 1e-6);
    EXPECT_NEAR(plane.normal_world.cast<double>().dot(center - asked_at), plane.offset_m, 1e-5);
  }
}

TEST(PlaneFit, AgreesWithAnIterativeEigensolver) {
  testing::Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Neighbors n = Patch(&random, random.Direction(), {1, 2, 3}, 0.5, 0.3, 0.02);
    const FittedPlane plane = FitPlane(n, {1, 2, 3}, {}, 0.1);
    if (!plane.exists()) continue;
    Eigen::Matrix<double, 3, 8> P;
    for (int j = 0; j < 8; ++j) P.col(j) << n.x[j], n.y[j], n.z[j];
    const Eigen::Vector3d mean = P.rowwise().mean();
    const Eigen::Matrix3d C = (P.colwise() - mean) * (P.colwise() - mean).transpose() / 8.0;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(C);
    const Eigen::Vector3d normal = plane.normal_world.cast<double>();
    EXPECT_NEAR(std::abs(normal.dot(eigen.eigenvectors().col(0))), 1.0, 1e-6);
    EXPECT_NEAR(plane.offset_m, normal.dot(mean), 1e-6);
    EXPECT_NEAR(plane.thickness_m, std::sqrt(eigen.eigenvalues()[0]), 5e-6);
    EXPECT_NEAR(plane.width_m, std::sqrt(eigen.eigenvalues()[1]), 5e-6);
  }
}

TEST(PlaneFit, TheVarianceOfANormalIsThatOfManyFits) {
  testing::Random random(9);
  const Eigen::Vector3d up(0, 0, 1), narrow = up.cross(up.unitOrthogonal());
  double squared_tilts = 0.0, variances = 0.0;
  int planes = 0;
  for (int i = 0; i < 20000; ++i) {
    const FittedPlane plane =
        FitPlane(Patch(&random, up, {0, 0, 0}, 1.0, 0.3, 0.01), {0, 0, 0}, {}, 0.1);
    if (!plane.exists()) continue;
    ++planes;
    const double tilt = plane.normal_world.cast<double>().dot(narrow);
    squared_tilts += tilt * tilt;
    variances += plane.normal_variance_rad2;
  }
  ASSERT_GT(planes, 10000);
  EXPECT_NEAR(variances / squared_tilts, 1.0, 0.1);
}

TEST(PlaneFit, RefusesAScanLineAThickCloudAndTooFewPoints) {
  testing::Random random(3);
  const Eigen::Vector3d up(0, 0, 1), origin(0, 0, 0);
  const auto fit = [&](const Neighbors& n) { return FitPlane(n, origin, {}, 0.1); };
  EXPECT_FALSE(fit(Patch(&random, up, origin, 1.0, 0.01, 0.001)).exists())
      << "points on one ring have no normal";
  EXPECT_FALSE(fit(Patch(&random, up, origin, 1.0, 1.0, 0.6)).exists());
  Neighbors few = Patch(&random, up, origin, 1.0, 1.0, 0.0);
  few.count = 4;
  EXPECT_FALSE(fit(few).exists());
  few.count = 0;
  EXPECT_FALSE(fit(few).exists());
}

}  // namespace
}  // namespace trajlo
