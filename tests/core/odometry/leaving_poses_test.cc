// SPDX-License-Identifier: MIT
#include "core/odometry/leaving_poses.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/odometry/health/window_statistics.h"

namespace trajlo {
namespace {

const MotionPrior kMotionPrior{{}};
constexpr std::int64_t kStep_ns = 100'000'000;
constexpr int kJump = 6;     // The first pose that is right again.
constexpr int kNewest = 10;  // The first pose of the present window.

/// Pose k, as the window that begins at pose `begin` has it: from kJump on, far to the side.
SE3 Pose(int k, int begin) {
  return {Eigen::Quaterniond::Identity(), {0.1 * k, begin < kJump ? 0.0 : 3.0, 0.0}};
}

/// The window of two segments that begins at pose k.
Window WindowAt(int k) {
  Window window;
  window.begin_ns = k * kStep_ns;
  window.T_world_begin = Pose(k, k);
  window.prior = AnchorOf(window.T_world_begin);
  for (int i = k; i < k + 2; ++i) {
    Segment segment;
    segment.cloud.begin_ns = i * kStep_ns;
    segment.cloud.end_ns = (i + 1) * kStep_ns;
    segment.T_world_end = Pose(i + 1, k);
    window.segments.push_back(segment);
  }
  return window;
}

/// Poses `first` to `last` - 1 leave, the very first one without a doubt.
void Leave(int first, int last, LeavingPoses* poses) {
  for (int k = first; k < last; ++k) {
    const Window window = WindowAt(k);
    poses->Leave(window, Matrix6d::Identity(), k > 0);
    poses->AddSegment(window.segments.front());
  }
}

TEST(LeavingPoses, AreFinalAtOnceWithoutADoubt) {
  FinalPoses final_poses;
  LeavingPoses poses({}, &kMotionPrior, &final_poses);
  poses.Leave(WindowAt(0), Matrix6d::Identity(), true);  // There is nothing before it.
  poses.Leave(WindowAt(1), Matrix6d::Identity(), false);
  EXPECT_EQ(final_poses.trajectory().poses().size(), 2U);
}

TEST(LeavingPoses, WaitWhileInDoubtAndAreFinalAsTheyAre) {
  FinalPoses final_poses;
  LeavingPoses poses({}, &kMotionPrior, &final_poses);
  Leave(0, 4, &poses);
  // Those that follow wait, too.
  poses.Leave(WindowAt(4), Matrix6d::Identity(), false);
  EXPECT_EQ(final_poses.trajectory().poses().size(), 1U);
  poses.Settle();
  ASSERT_EQ(final_poses.trajectory().poses().size(), 5U);
  for (int k = 0; k < 5; ++k) {
    const ControlPose& pose = final_poses.trajectory().poses()[static_cast<std::size_t>(k)];
    EXPECT_EQ(pose.t_ns, k * kStep_ns);
    EXPECT_EQ(pose.T_world_body.t, Pose(k, k).t);
  }
}

TEST(LeavingPoses, WaitForFiveSecondsAtMost) {
  FinalPoses final_poses;
  LeavingPoses poses({}, &kMotionPrior, &final_poses);
  Leave(0, 60, &poses);
  // 51 poses are 5 s.
  EXPECT_EQ(final_poses.trajectory().poses().size(), 60U - 51U);
}

/// Two estimates are offered; that with a point on a plane is taken.
TEST(LeavingPoses, AreThoseThatBringMorePointsOntoPlanes) {
  for (const int better : {0, 1}) {
    FinalPoses final_poses;
    LeavingPoses poses({}, &kMotionPrior, &final_poses);
    Leave(0, kNewest, &poses);
    int estimates = 0;
    poses.SmoothBack(WindowAt(kNewest), [&](Window joined) -> std::optional<Window> {
      joined.segments[2].T_world_end.t.z() = estimates;
      RegistrationPoint on_plane = {};
      on_plane.p_body_m.setZero();
      on_plane.alpha = 1.0;
      on_plane.normal_world = Eigen::Vector3d::UnitZ();
      on_plane.offset_m = joined.segments[2].T_world_end.t.z();
      on_plane.weight = 1.0;
      if (estimates == better) joined.segments[2].points = {on_plane};
      ++estimates;
      return joined;
    });
    EXPECT_EQ(estimates, 2);
    ASSERT_EQ(final_poses.trajectory().poses().size(), static_cast<std::size_t>(kNewest));
    EXPECT_EQ(final_poses.trajectory().poses()[4].T_world_body.t.z(), better);
  }
}

TEST(LeavingPoses, StayWhereTheyAreIfNoEstimateSucceeds) {
  FinalPoses final_poses;
  LeavingPoses poses({}, &kMotionPrior, &final_poses);
  Leave(0, kNewest, &poses);
  poses.SmoothBack(WindowAt(kNewest), [](const Window&) { return std::nullopt; });
  ASSERT_EQ(final_poses.trajectory().poses().size(), static_cast<std::size_t>(kNewest));
  for (int k = 0; k < kNewest; ++k) {
    const ControlPose& pose = final_poses.trajectory().poses()[static_cast<std::size_t>(k)];
    EXPECT_EQ(pose.T_world_body.t, Pose(k, k).t) << k;
  }
}

TEST(LeavingPoses, AreNotEstimatedAgainIfNoneJumped) {
  FinalPoses final_poses;
  LeavingPoses poses({}, &kMotionPrior, &final_poses);
  Leave(0, kJump - 2, &poses);
  poses.SmoothBack(WindowAt(kJump - 2), [](const Window&) {
    ADD_FAILURE() << "nothing to estimate";
    return std::nullopt;
  });
  EXPECT_EQ(final_poses.trajectory().poses().size(), static_cast<std::size_t>(kJump - 2));
}

TEST(LeavingPoses, AreFlaggedFromTheFirstLossOn) {
  FinalPoses final_poses;
  LeavingPoses poses({}, &kMotionPrior, &final_poses);
  poses.Lose(2 * kStep_ns);
  poses.Lose(1 * kStep_ns);
  for (int k = 0; k < 4; ++k) poses.Leave(WindowAt(k), Matrix6d::Identity(), false);
  for (int k = 0; k < 4; ++k) {
    const unsigned flags = final_poses.trajectory().poses()[static_cast<std::size_t>(k)].flags;
    EXPECT_EQ(flags, k < 2 ? 0U : kFlagLost) << k;
  }
}

}  // namespace
}  // namespace trajlo
