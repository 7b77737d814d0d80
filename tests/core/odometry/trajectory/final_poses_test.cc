// SPDX-License-Identifier: MIT
#include "core/odometry/trajectory/final_poses.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace trajlo {
namespace {

LeavingPose At(std::int64_t t_ns) {
  return {{t_ns, SE3(), 0}, double(t_ns) * Matrix6d::Identity()};
}

TEST(FinalPoses, AreHandedOnOnceAndInOrder) {
  FinalPoses poses;
  std::vector<std::int64_t> seen;
  poses.OnPose([&](const ControlPose& pose, const Matrix6d& covariance) {
    EXPECT_EQ(covariance(0, 0), double(pose.t_ns));
    seen.push_back(pose.t_ns);
  });
  poses.Append(At(1));
  poses.Append(At(2));
  EXPECT_TRUE(seen.empty());
  poses.HandOn();
  poses.Append(At(3));
  poses.HandOn();
  poses.HandOn();
  EXPECT_EQ(seen, (std::vector<std::int64_t>{1, 2, 3}));
}

TEST(FinalPoses, TheFirstOneCanBeFlaggedUntilTheNextOneIsFinal) {
  FinalPoses poses;
  poses.Begin({1, SE3(), 4});
  poses.FlagFirst(2);
  EXPECT_TRUE(poses.trajectory().empty());
  poses.Append(At(2));
  poses.FlagFirst(8);
  ASSERT_EQ(poses.trajectory().poses().size(), 2U);
  EXPECT_EQ(poses.trajectory().poses()[0].flags, 6U);
  EXPECT_EQ(poses.trajectory().poses()[1].flags, 0U);
}

TEST(FinalPoses, AFirstOneThatIsForgottenIsNone) {
  FinalPoses poses;
  poses.Begin({1, SE3(), 0});
  poses.ForgetFirst();
  poses.Append(At(2));
  ASSERT_EQ(poses.trajectory().poses().size(), 1U);
  EXPECT_EQ(poses.trajectory().poses()[0].t_ns, 2);
}

TEST(FinalPoses, ACallbackThatThrowsLosesNoOtherPose) {
  FinalPoses poses;
  std::vector<std::int64_t> seen;
  poses.OnPose([&](const ControlPose& pose, const Matrix6d&) {
    if (pose.t_ns == 1) throw std::runtime_error("full");
    seen.push_back(pose.t_ns);
  });
  poses.Append(At(1));
  poses.Append(At(2));
  EXPECT_THROW(poses.HandOn(), std::runtime_error);
  poses.HandOn();
  EXPECT_EQ(seen, (std::vector<std::int64_t>{2}));
}

}  // namespace
}  // namespace trajlo
