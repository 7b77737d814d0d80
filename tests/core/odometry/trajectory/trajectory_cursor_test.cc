// SPDX-License-Identifier: MIT
#include "core/odometry/trajectory/trajectory_cursor.h"

#include <gtest/gtest.h>

#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

using Time = TrajectoryCursor::Time;

TEST(TrajectoryCursor, PlacesPointsAsTheTrajectoryDoesInAnyOrderOfTimes) {
  testing::Random random(3);
  Trajectory trajectory;
  for (const int t : {0, 100, 130, 200}) trajectory.Append({t, se3::Exp(random.Tangent(0.5, 2.0))});
  TrajectoryCursor cursor(&trajectory, 1000);
  const Eigen::Vector3d p_body(1.0, -2.0, 0.5);
  for (const int t : {0, 1, 99, 100, 101, 130, 50, 200, 0, 131, 100}) {
    ASSERT_EQ(cursor.MoveTo(t), Time::kCovered) << t;
    EXPECT_LT((cursor.ToWorld(p_body) - *trajectory.At(t) * p_body).norm(), 1e-9) << t;
  }
  EXPECT_EQ(cursor.MoveTo(-1), Time::kOutside);
  EXPECT_EQ(cursor.MoveTo(201), Time::kOutside);
}

TEST(TrajectoryCursor, OfAPauseOnlyItsEndsAreCovered) {
  testing::Random random(4);
  Trajectory trajectory;
  for (const int t : {0, 100, 2000, 2100})
    trajectory.Append({t, se3::Exp(random.Tangent(0.5, 2.0))});
  TrajectoryCursor cursor(&trajectory, 1000);
  const Eigen::Vector3d p_body(1.0, -2.0, 0.5);
  EXPECT_EQ(cursor.MoveTo(101), Time::kInPause);
  EXPECT_EQ(cursor.MoveTo(1999), Time::kInPause);
  for (const int t : {100, 2000, 2001}) {
    ASSERT_EQ(cursor.MoveTo(t), Time::kCovered) << t;
    EXPECT_LT((cursor.ToWorld(p_body) - *trajectory.At(t) * p_body).norm(), 1e-9) << t;
  }
  EXPECT_EQ(cursor.MoveTo(1500), Time::kInPause);
}

TEST(TrajectoryCursor, OnePoseIsCoveredAndNoneIsNot) {
  Trajectory trajectory;
  EXPECT_EQ(TrajectoryCursor(&trajectory, 1000).MoveTo(5), Time::kOutside);
  trajectory.Append({5, SE3(Eigen::Quaterniond::Identity(), {1.0, 2.0, 3.0})});
  TrajectoryCursor cursor(&trajectory, 1000);
  ASSERT_EQ(cursor.MoveTo(5), Time::kCovered);
  EXPECT_EQ(cursor.ToWorld({1.0, 0.0, 0.0}), Eigen::Vector3d(2.0, 2.0, 3.0));
  EXPECT_EQ(cursor.MoveTo(6), Time::kOutside);
}

}  // namespace
}  // namespace trajlo
