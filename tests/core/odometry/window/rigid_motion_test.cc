// SPDX-License-Identifier: MIT
#include "core/odometry/window/rigid_motion.h"

#include <gtest/gtest.h>

#include "tests/support/random_poses.h"
#include "tests/support/random_segment.h"

namespace trajlo {
namespace {

using testing::Random;

/// A segment, and the frame that it moves with.
struct Segment {
  explicit Segment(Random* random) {
    frame = random->Pose();
    begin = random->Pose();
    end = Plus(begin, random->Tangent(0.3, 0.5));
    A = RigidMotionOfEnds(frame, begin, end);
  }

  /// The pose after the rigid motion.
  SE3 Moved(const SE3& T, const Vector6d& xi) const {
    return frame * se3::Exp(xi) * frame.Inverse() * T;
  }

  SE3 frame, begin, end;
  Eigen::Matrix<double, 12, 6> A;
};

TEST(RigidMotion, MovesBothEndsAsTheFrameMoves) {
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    const Segment segment(&random);
    const Vector6d xi = random.Tangent(1.0, 2.0);
    const Vector12d of_ends = segment.A * xi;
    EXPECT_LT(
        Minus(segment.Moved(segment.begin, xi), Plus(segment.begin, of_ends.head<6>())).norm(),
        1e-12);
    EXPECT_LT(Minus(segment.Moved(segment.end, xi), Plus(segment.end, of_ends.tail<6>())).norm(),
              1e-12);
  }
}

TEST(RigidMotion, TurnsTheEquationsOfASegmentIntoThoseOfTheMotion) {
  Random random(2);
  const Segment segment(&random);
  const RegistrationNoise noise{0.1};
  const auto points = RandomSegment(&random, segment.begin, segment.end, 200, 0.05);
  const auto cost = [&](const Vector6d& xi) {
    return LinearizeSegment(points, segment.Moved(segment.begin, xi),
                            segment.Moved(segment.end, xi), noise)
        .cost;
  };
  const Vector6d g =
      segment.A.transpose() * LinearizeSegment(points, segment.begin, segment.end, noise).g;
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 6; ++i) {
    const Vector6d step = kStep * Vector6d::Unit(i);
    EXPECT_NEAR((cost(step) - cost(-step)) / (2.0 * kStep), g[i], 1e-5 * g.norm()) << i;
  }
}

TEST(RigidMotion, GivesTheWholeHessianWherePointsLieOnTheirPlanes) {
  Random random(3);
  const Segment segment(&random);
  const RegistrationNoise noise{0.1};
  const auto points = RandomSegment(&random, segment.begin, segment.end, 200, 0.0);
  const Matrix6d H = segment.A.transpose() *
                     LinearizeSegment(points, segment.begin, segment.end, noise).H * segment.A;
  for (int i = 0; i < 20; ++i) {
    const Vector6d xi = random.Tangent(1e-4, 1e-4);
    const double cost = LinearizeSegment(points, segment.Moved(segment.begin, xi),
                                         segment.Moved(segment.end, xi), noise)
                            .cost;
    const double expected = 0.5 * xi.dot(H * xi);
    EXPECT_NEAR(cost, expected, 1e-2 * expected);
  }
}

}  // namespace
}  // namespace trajlo
