// SPDX-License-Identifier: MIT
#include "core/report/pose_flags.h"

#include <gmock/gmock.h>

#include "core/odometry/health/window_statistics.h"
#include "core/report/flag_warnings.h"

namespace trajlo {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kSecond = 1'000'000'000;

/// At 0, 1, 3 and 4 s; a pause before the third pose.
std::vector<ControlPose> Poses() {
  return {{0, SE3(), 0}, {kSecond, SE3(), 0}, {3 * kSecond, SE3(), kFlagGap}, {4 * kSecond, {}, 0}};
}

TEST(PoseFlags, CountPosesAndTheTimeBeforeThem) {
  const PoseFlags flags(Poses(), std::nullopt);
  EXPECT_EQ(flags.totals().at("gap").poses, 1u);
  EXPECT_EQ(flags.totals().at("gap").seconds, 2.0);
  EXPECT_EQ(flags.totals().at("lost").poses, 0u);
  EXPECT_EQ(flags.any().poses, 1u);
  EXPECT_EQ(flags.seconds(), 4.0);
}

TEST(PoseFlags, TellTheLongestTimeOnEnd) {
  std::vector<ControlPose> poses(11);
  for (int i = 0; i < 11; ++i) poses[i].t_ns = i * kSecond;
  for (const int i : {1, 2, 4, 5, 6, 9}) poses[i].flags = kFlagDegenerate;
  poses[7].flags = kFlagJump;
  const PoseFlags flags(poses, std::nullopt);
  EXPECT_EQ(flags.totals().at("degenerate").longest_s, 3.0);
  EXPECT_EQ(flags.totals().at("degenerate").seconds, 6.0);
  EXPECT_EQ(flags.totals().at("jump").longest_s, 1.0);
  EXPECT_EQ(flags.totals().at("gap").longest_s, 0.0);
  EXPECT_EQ(flags.any().longest_s, 4.0);
}

TEST(PoseFlags, WhatLiesInAPauseHasItsFlagAndWhatFollowsHasNot) {
  const PoseFlags flags(Poses(), std::nullopt);
  EXPECT_EQ(flags.At(kSecond), 0u);
  EXPECT_EQ(flags.At(kSecond + 1), kFlagGap);
  EXPECT_EQ(flags.At(3 * kSecond), kFlagGap);
  EXPECT_EQ(flags.At(3 * kSecond + 1), 0u);
}

TEST(PoseFlags, AllPosesAreLostFromTheFirstThatMustNotBeTrusted) {
  const PoseFlags flags(Poses(), kSecond + 1);
  EXPECT_EQ(flags.At(kSecond), 0u);
  EXPECT_EQ(flags.At(2 * kSecond), kFlagGap | kFlagLost);
  EXPECT_EQ(flags.At(4 * kSecond), kFlagLost);
  EXPECT_EQ(flags.totals().at("lost").seconds, 3.0);
}

TEST(PoseFlags, AreATableBesideTheTrajectory) {
  const PoseFlags flags(Poses(), std::nullopt);
  EXPECT_EQ(FlagsCsv(flags, {kSecond, 2 * kSecond}),
            "t_s,flags,flag_names\n1.000000000,0,\n2.000000000,2,gap\n");
}

TEST(PoseFlags, PosesAreThoseThatWereWritten) {
  PoseFlags flags(Poses(), std::nullopt);
  flags.CountPosesAt({kSecond, kSecond + 1, 2 * kSecond, 4 * kSecond});
  EXPECT_EQ(flags.any().poses, 2u);
  EXPECT_EQ(flags.totals().at("gap").poses, 2u);
  EXPECT_EQ(flags.totals().at("gap").control_poses, 1u);
  EXPECT_EQ(flags.totals().at("gap").seconds,
            PoseFlags(Poses(), std::nullopt).totals().at("gap").seconds);
  flags.CountPosesAt({});
  EXPECT_EQ(flags.any().poses, 0u);
}

TEST(FlagWarnings, SayForHowLongAndInWhichDirection) {
  RunSummary summary;
  EXPECT_TRUE(FlagWarnings(summary).empty());
  std::vector<ControlPose> poses = Poses();
  poses[1].flags = kFlagFewInliers;
  poses[3].flags = kFlagDegenerate;
  summary.flags = PoseFlags(poses, std::nullopt);
  summary.windows.weak_axes = {{"about_z", 2}, {"x", 5}};
  const std::vector<std::string> warnings = FlagWarnings(summary);
  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_THAT(warnings[0], HasSubstr("2.00 s (50.0 %) in 1 stretch"));
  EXPECT_THAT(warnings[1], HasSubstr("motion along x of the body"));
  EXPECT_THAT(warnings[2], HasSubstr("for 1.00 s (25.0 %) too few points agree with the map"));
}

}  // namespace
}  // namespace trajlo
