// SPDX-License-Identifier: MIT
#include "core/odometry/trajectory/trajectory.h"

#include <gtest/gtest.h>

#include "manifolds/se3_interpolation.h"
#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

TEST(Trajectory, AnswersAtControlPosesBetweenThemAndNotOutside) {
  testing::Random random;
  Trajectory trajectory;
  EXPECT_FALSE(trajectory.At(0));
  for (int i = 0; i < 5; ++i) trajectory.Append({1000 + 100 * i, random.Pose(), 0});
  EXPECT_FALSE(trajectory.At(999));
  EXPECT_FALSE(trajectory.At(1401));
  for (const ControlPose& pose : trajectory.poses()) {
    EXPECT_EQ(trajectory.At(pose.t_ns)->q.coeffs(), pose.T_world_body.q.coeffs());
    EXPECT_EQ(trajectory.At(pose.t_ns)->t, pose.T_world_body.t);
  }
  const SE3 expected =
      Interpolate(trajectory.poses()[1].T_world_body, trajectory.poses()[2].T_world_body, 0.25);
  EXPECT_LT(Minus(*trajectory.At(1125), expected).norm(), 1e-14);
}

TEST(Trajectory, RefusesTimesThatDoNotIncrease) {
  Trajectory trajectory;
  trajectory.Append({10, SE3(), 0});
  EXPECT_THROW(trajectory.Append({10, SE3(), 0}), std::invalid_argument);
}

}  // namespace
}  // namespace trajlo
