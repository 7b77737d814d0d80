// SPDX-License-Identifier: MIT
#include "core/odometry/window/spurious_information.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/odometry/health/condition.h"
#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

RegistrationOptions TenShareAnError() {
  RegistrationOptions registration;
  registration.points_per_error = 10.0;
  return registration;
}

using testing::Random;

/// Points of a corridor along x, or of a room, whose normals are off by noise.
std::vector<RegistrationPoint> NoisyPoints(Random* random, int count, bool is_room,
                                           double normal_sigma_rad) {
  std::vector<RegistrationPoint> points;
  for (int i = 0; i < count; ++i) {
    const int axis = is_room ? i % 3 : 1 + i % 2;
    Eigen::Vector3d p = random->PlaceIn({8, 2, 2});
    p[axis] = std::copysign(3.0, p[axis]);
    Eigen::Vector3d normal = Eigen::Vector3d::Unit(axis);
    const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
    normal += random->Gaussian(normal_sigma_rad) * u;
    normal += random->Gaussian(normal_sigma_rad) * v;
    normal.normalize();
    points.push_back({p, random->Uniform(0, 1), normal, normal.dot(p), random->Uniform(0.3, 1),
                      normal_sigma_rad * normal_sigma_rad});
  }
  return points;
}

/// H of a rigid motion of the segment, in the frame of its begin.
Matrix6d RigidH(const std::vector<RegistrationPoint>& points, const SE3& T_begin, const SE3& T_end,
                const RegistrationNoise& noise) {
  Eigen::Matrix<double, 12, 6> A;
  A << Matrix6d::Identity(), se3::Adjoint(T_end.Inverse() * T_begin);
  return A.transpose() * LinearizeSegment(points, T_begin, T_end, noise).H * A;
}

TEST(SpuriousInformation, IsInTheMeanWhatNoisyNormalsAddToTheTrueInformation) {
  Random random(4);
  const RegistrationNoise noise = {0.05, {KernelKind::kNone, 1.0}};
  const SE3 T_begin = random.Pose();
  const SE3 T_end = Plus(T_begin, random.Tangent(0.3, 0.2));
  constexpr double kSigma_rad = 0.1;
  Matrix6d truth = Matrix6d::Zero(), noisy = Matrix6d::Zero(), spurious = Matrix6d::Zero();
  for (int trial = 0; trial < 3000; ++trial) {
    std::vector<RegistrationPoint> points = NoisyPoints(&random, 100, false, kSigma_rad);
    noisy += RigidH(points, T_begin, T_end, noise);
    spurious += SpuriousInformationOf(points, T_begin, T_end, noise).mean;
    for (RegistrationPoint& point : points) {
      // The corridor has normals along y and z only.
      int axis;
      point.normal_world.cwiseAbs().maxCoeff(&axis);
      point.normal_world = Eigen::Vector3d::Unit(axis);
    }
    truth += RigidH(points, T_begin, T_end, noise);
  }
  // A normal that is off by two angles of variance s keeps 1 / (1 + s (a² + b²)) of its true
  // component's square, a and b standard normal: in the mean about 1 - 2 s + 8 s².
  constexpr double s = kSigma_rad * kSigma_rad;
  truth *= 1.0 - 2.0 * s + 8.0 * s * s;
  const double size = spurious.norm();
  ASSERT_GT((noisy - truth).norm(), 0.8 * size);
  EXPECT_LT((noisy - spurious - truth).norm(), 0.1 * size);
  // Along the corridor there is nothing but noise.
  Vector6d along = Vector6d::Zero();
  along.head<3>() = T_begin.q.conjugate() * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(along.dot((noisy - spurious) * along) / along.dot(noisy * along), 0.0, 0.1);
}

Window WindowOf(std::vector<RegistrationPoint> points) {
  Window window;
  window.noise = {0.1, {KernelKind::kCauchy, 1.0}};
  Segment segment;
  segment.points = std::move(points);
  segment.registration = LinearizeSegment(segment.points, SE3(), SE3(), window.noise);
  segment.spurious = SpuriousInformationOf(segment.points, SE3(), SE3(), window.noise);
  window.segments.push_back(std::move(segment));
  return window;
}

TEST(SpuriousInformation, ACorridorOfNoisyNormalsTellsNothingAndARoomDoes) {
  Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    Window corridor = WindowOf(NoisyPoints(&random, 1000, false, 0.15));
    WindowCondition condition = ConditionOf(corridor, TenShareAnError());
    EXPECT_EQ(condition.smallest_eigenvalue, 0.0);
    EXPECT_GT(std::abs(condition.weak_direction[0]), 0.9);
    // What the noise seems to tell: 5 cm.
    corridor.segments[0].spurious = {};
    condition = ConditionOf(corridor, TenShareAnError());
    EXPECT_GT(condition.smallest_eigenvalue, 1.0 / (0.05 * 0.05));

    const Window room = WindowOf(NoisyPoints(&random, 1000, true, 0.15));
    EXPECT_GT(ConditionOf(room, TenShareAnError()).smallest_eigenvalue, 1.0 / (0.03 * 0.03));
  }
}

/// A corridor along x with exact normals, and `count` points on walls across it, all on the same
/// place or each on one of its own.
std::vector<RegistrationPoint> CorridorWithEndWall(Random* random, int count, double spread_m) {
  std::vector<RegistrationPoint> points = NoisyPoints(random, 1000, false, 1e-6);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d p(8.0, random->Uniform(-1, 1) * spread_m,
                            random->Uniform(-1, 1) * spread_m);
    points.push_back({p, 1.0, Eigen::Vector3d::UnitX(), p.x(), 1.0, 1e-6});
  }
  return points;
}

TEST(SpuriousInformation, WhatHangsOnFewPlacesMayBeFalse) {
  Random random(7);
  // A point alone tells 10 cm (1/m²: 100). Four hundred on one place may be one mistake.
  EXPECT_LT(ConditionOf(WindowOf(CorridorWithEndWall(&random, 5, 1.5)), TenShareAnError())
                .smallest_eigenvalue,
            100.0);
  const WindowCondition on_one_place =
      ConditionOf(WindowOf(CorridorWithEndWall(&random, 400, 0.1)), TenShareAnError());
  EXPECT_EQ(on_one_place.smallest_eigenvalue, 0.0);
  EXPECT_GT(std::abs(on_one_place.weak_direction[0]), 0.9);
  EXPECT_GT(ConditionOf(WindowOf(CorridorWithEndWall(&random, 400, 3.0)), TenShareAnError())
                .smallest_eigenvalue,
            2500.0);
}

TEST(SpuriousInformation, APlaneThatMayBeNoSurfaceTellsNothing) {
  Random random(8);
  std::vector<RegistrationPoint> points = CorridorWithEndWall(&random, 400, 3.0);
  for (RegistrationPoint& point : points) {
    if (point.normal_world.x() == 1.0) {
      point.normal_variance_rad2 = std::numeric_limits<double>::infinity();
    }
  }
  const WindowCondition condition = ConditionOf(WindowOf(points), TenShareAnError());
  EXPECT_LT(condition.smallest_eigenvalue, 1e-3);
  EXPECT_GT(std::abs(condition.weak_direction[0]), 0.9);
}

TEST(SpuriousInformation, GroupsOfPlacesAddUpToTheInformation) {
  Random random(9);
  const RegistrationNoise noise = {0.05, {KernelKind::kCauchy, 1.0}};
  const SE3 T_begin = random.Pose();
  const SE3 T_end = Plus(T_begin, random.Tangent(0.3, 0.2));
  const std::vector<RegistrationPoint> points = NoisyPoints(&random, 500, true, 0.1);
  const SpuriousInformation spurious = SpuriousInformationOf(points, T_begin, T_end, noise);
  const Matrix6d H = RigidH(points, T_begin, T_end, noise);
  Matrix6d sum = Matrix6d::Zero();
  for (const Matrix6d& group : spurious.by_place) sum += group;
  EXPECT_LT((sum - H).norm(), 1e-9 * H.norm());
}

TEST(SpuriousInformation, AsManyErrorsAsUnknownsTellNothing) {
  Random random(6);
  const Window few = WindowOf(NoisyPoints(&random, 60, true, 0.0));
  EXPECT_EQ(ConditionOf(few, TenShareAnError()).smallest_eigenvalue, 0.0);
  const Window more = WindowOf(NoisyPoints(&random, 400, true, 0.0));
  EXPECT_GT(ConditionOf(more, TenShareAnError()).smallest_eigenvalue, 100.0);
}

}  // namespace
}  // namespace trajlo
