// SPDX-License-Identifier: MIT
#include "core/odometry/map/plane_fit.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

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

/// The plane through all points but one (or, for -1, through all), by an iterative solver.
struct Exact {
  Eigen::Vector3d normal, mean;
  Eigen::Vector3d sigmas;

  Exact(const Neighbors& n, int without) {
    Eigen::Matrix3Xd P(3, n.count);
    int count = 0;
    for (int j = 0; j < n.count; ++j) {
      if (j != without) P.col(count++) << n.x[j], n.y[j], n.z[j];
    }
    P.conservativeResize(3, count);
    mean = P.rowwise().mean();
    P.colwise() -= mean;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(P * P.transpose() / count);
    normal = eigen.eigenvectors().col(0);
    sigmas = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  }
};

TEST(PlaneFit, AgreesWithAnIterativeEigensolver) {
  testing::Random random(2);
  int planes = 0;
  for (int i = 0; i < 200; ++i) {
    const Neighbors n = Patch(&random, random.Direction(), {1, 2, 3}, 0.5, 0.3, 0.02);
    const FittedPlane plane = FitPlane(n, {1, 2, 3}, {}, 0.1);
    if (!plane.exists()) continue;
    ++planes;
    const Exact exact(n, -1);
    const Eigen::Vector3d normal = plane.normal_world.cast<double>();
    EXPECT_NEAR(std::abs(normal.dot(exact.normal)), 1.0, 1e-6);
    EXPECT_NEAR(plane.offset_m, normal.dot(exact.mean), 1e-6);
    EXPECT_NEAR(plane.width_m, exact.sigmas[1], 5e-6);
  }
  EXPECT_GT(planes, 150);
}

TEST(PlaneFit, TheThicknessIsHowFarPointsLieFromThePlaneThroughTheOthers) {
  testing::Random random(5);
  int planes = 0;
  for (int i = 0; i < 200; ++i) {
    const Neighbors n = Patch(&random, random.Direction(), {0, 0, 0}, 0.5, 0.5, 0.001);
    const FittedPlane plane = FitPlane(n, {0, 0, 0}, {}, 0.1);
    if (!plane.exists()) continue;
    ++planes;
    double squares = 0.0;
    for (int j = 0; j < n.count; ++j) {
      const Exact others(n, j);
      const Eigen::Vector3d p(n.x[j], n.y[j], n.z[j]);
      squares += std::pow(others.normal.dot(p - others.mean), 2) / n.count;
    }
    // The formula is exact for planes z = a x + b y + c; these are nearly that.
    EXPECT_NEAR(plane.thickness_m / std::sqrt(squares), 1.0, 0.02);
  }
  EXPECT_GT(planes, 150);
}

TEST(PlaneFit, RefusesAScanLineAndAPointBesideIt) {
  testing::Random random(6);
  for (int i = 0; i < 500; ++i) {
    // A ring on the road, with the noise of ranges, and a point of a post above it.
    Neighbors n;
    n.count = 10;
    for (int j = 0; j < 10; ++j) {
      const bool is_post = j == 9;
      n.x[j] = static_cast<float>(random.Gaussian(0.02));
      n.y[j] = static_cast<float>(is_post ? 0.3 : 0.12 * j);
      n.z[j] = static_cast<float>(is_post ? 0.5 : random.Gaussian(0.001));
    }
    const Exact exact(n, -1);
    EXPECT_LT(exact.sigmas[0], 0.2 * exact.sigmas[1]) << "it fits its points well";
    const FittedPlane plane = FitPlane(n, {0, 0, 0}, {}, 0.12);
    EXPECT_FALSE(plane.exists() && plane.thickness_m < 0.1);

    // Without noise nothing tells how the others would foretell it.
    for (int j = 0; j < 10; ++j) n.x[j] = 0.0F;
    for (int j = 0; j < 9; ++j) n.z[j] = 0.0F;
    EXPECT_FALSE(FitPlane(n, {0, 0, 0}, {}, 0.12).exists());
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
  EXPECT_FALSE(fit(Patch(&random, up, origin, 1.0, 1.0, 1.0)).exists());
  Neighbors few = Patch(&random, up, origin, 1.0, 1.0, 0.0);
  few.count = 4;
  EXPECT_FALSE(fit(few).exists());
  few.count = 0;
  EXPECT_FALSE(fit(few).exists());
}

TEST(PlaneFit, ItsNormalPointsToWhereAllNeighboursWereSeenFrom) {
  testing::Random random(8);
  int planes = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d normal = random.Direction();
    const Eigen::Vector3d center = 10.0 * random.Direction();
    Neighbors neighbors = Patch(&random, normal, center, 0.3, 0.3, 0.001);
    EXPECT_FALSE(FitPlane(neighbors, center, {}, 0.1).is_one_sided) << "nobody knows";

    const Eigen::Vector3d sensor = center + normal + 0.5 * random.Direction();
    for (SeenFrom& seen_from : neighbors.seen_from) {
      seen_from = SeenFrom((sensor - center).cast<float>());
    }
    const FittedPlane plane = FitPlane(neighbors, center, {}, 0.1);
    if (!plane.exists()) continue;  // Nearly on a line.
    ++planes;
    EXPECT_TRUE(plane.is_one_sided);
    EXPECT_GT(plane.normal_world.cast<double>().dot(normal), 0.9);
    EXPECT_NEAR(plane.offset_m, 0.0, 0.01);
    const Eigen::Vector3f ray = (center - sensor).cast<float>();
    EXPECT_FALSE(plane.IsBehind(ray));
    EXPECT_TRUE(plane.IsBehind(-ray));

    // One that was seen from the other side is enough.
    neighbors.seen_from[3] = SeenFrom(ray);
    const FittedPlane both = FitPlane(neighbors, center, {}, 0.1);
    EXPECT_FALSE(both.is_one_sided);
    EXPECT_FALSE(both.IsBehind(-ray));
  }
  EXPECT_GT(planes, 150);
}

}  // namespace
}  // namespace trajlo
