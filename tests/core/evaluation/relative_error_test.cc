// SPDX-License-Identifier: MIT
#include "core/evaluation/relative_error.h"

#include <gmock/gmock.h>

#include <limits>

#include "core/evaluation/error_statistics.h"
#include "core/scans/nanoseconds.h"
#include "tests/core/evaluation/synthetic_poses.h"

namespace trajlo::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

TEST(RelativePairs, FramesInARowOrFromEveryOne) {
  EXPECT_THAT(PairsOverFrames(6, 2, false), ElementsAre(Pair(0, 2), Pair(2, 4)));
  EXPECT_THAT(PairsOverFrames(4, 2, true), ElementsAre(Pair(0, 2), Pair(1, 3)));
  EXPECT_THAT(PairsOverFrames(2, 2, true), IsEmpty());
}

TEST(RelativePairs, PiecesOfPathBeginAtTheFirstPose) {
  const auto poses = OnALine({0.0, 0.6, 1.2, 1.8, 2.4, 3.0}).T_world_body;
  EXPECT_THAT(ConsecutivePairsOverDistance(poses, 1.0), ElementsAre(Pair(0, 2), Pair(2, 4)));
  EXPECT_THAT(ConsecutivePairsOverDistance(poses, 4.0), IsEmpty());
}

TEST(RelativePairs, AllPiecesOfPathAreThoseWithinTheTolerance) {
  const auto poses = OnALine({0.0, 0.95, 1.06, 3.0, 4.0, 4.0}).T_world_body;
  // From 0 both are near enough and the nearer one counts; a stop counts once.
  EXPECT_THAT(AllPairsOverDistance(poses, 1.0, 0.1), ElementsAre(Pair(0, 1), Pair(3, 4)));
}

TEST(RelativePairs, AnglesAddUpInBothDirections) {
  std::vector<Eigen::Affine3d> poses;
  for (const double deg : {0.0, 3.0, 0.0, 3.0, 6.0, 9.0}) {
    poses.emplace_back(Eigen::AngleAxisd(deg * M_PI / 180.0, Eigen::Vector3d::UnitX()));
  }
  EXPECT_THAT(ConsecutivePairsOverAngle(poses, 5.0), ElementsAre(Pair(0, 2), Pair(2, 4)));
}

TEST(RelativePairs, PiecesOfTimeAreNotStretchedOverGaps) {
  std::vector<std::int64_t> t_ns;
  for (const double t_s : {0.0, 0.5, 1.0, 1.5, 4.0, 4.5, 5.0, 5.5})
    t_ns.push_back(Nanoseconds(t_s));
  EXPECT_THAT(AllPairsOverTime(t_ns, 1.0, 0.1), ElementsAre(Pair(0, 2), Pair(1, 3), Pair(4, 6)));
  // As the TUM benchmark: the nearest, however far, but never the last one.
  EXPECT_THAT(AllPairsOverTime(t_ns, 1.0, std::numeric_limits<double>::infinity()),
              ElementsAre(Pair(0, 2), Pair(1, 3), Pair(2, 3), Pair(4, 6)));
}

TEST(RelativeErrors, DoNotDependOnTheWorldOfTheEstimate) {
  const TimedPoses truth = SmoothPoses(0.0, 0.1, 40);
  const Eigen::Affine3d T_other_world =
      Eigen::Translation3d(5, 6, 7) * Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitY());
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    pairs.push_back(
        {truth.t_ns[i], i, T_other_world * truth.T_world_body[i], truth.T_world_body[i]});
  }
  const PoseErrors same = RelativeErrors(pairs, PairsOverFrames(40, 3, true), true);
  EXPECT_LT(ComputeStatistics(same.full).max, 1e-13);
  // A kick of 0.5 m in the body's x hits exactly the pieces that contain it.
  for (std::size_t i = 20; i < pairs.size(); ++i) {
    pairs[i].estimate = pairs[i].estimate * Eigen::Translation3d(0.5, 0.0, 0.0);
  }
  const PoseErrors kicked = RelativeErrors(pairs, PairsOverFrames(40, 1, true), true);
  EXPECT_NEAR(kicked.translation_m[19], 0.5, 1e-12);
  EXPECT_NEAR(kicked.translation_m[18], 0.0, 1e-12);
  EXPECT_LT(ComputeStatistics(kicked.rotation_deg).max, 1e-12);
}

TEST(RelativeErrors, APieceOfSecondsNeedsAPartnerAtItsVeryEnd) {
  const TimedPoses all = SmoothPoses(0.0, 0.5, 6);
  std::vector<PosePair> pairs;
  for (const std::size_t i : {0u, 1u, 3u, 4u, 5u}) {  // 2 has no partner.
    pairs.push_back({all.t_ns[i], i, all.T_world_body[i], all.T_world_body[i]});
  }
  RelativeErrorOptions second;
  second.unit = DeltaUnit::kSeconds;
  EXPECT_THAT(SelectPieces(pairs, all.t_ns, second), ElementsAre(Pair(2, 1)));
}

TEST(ErrorStatistics, AreThoseOfTheTextbook) {
  const ErrorStatistics s = ComputeStatistics({4.0, 1.0, 2.0, 3.0});
  EXPECT_EQ(s.count, 4u);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(7.5));
  EXPECT_DOUBLE_EQ(s.mean, 2.5);
  EXPECT_DOUBLE_EQ(s.median, 2.5);
  EXPECT_DOUBLE_EQ(s.std, std::sqrt(1.25));
  EXPECT_DOUBLE_EQ(s.min, 1.0);
  EXPECT_DOUBLE_EQ(s.max, 4.0);
  EXPECT_DOUBLE_EQ(s.sse, 30.0);
  EXPECT_DOUBLE_EQ(ComputeStatistics({5.0, 1.0, 2.0}).median, 2.0);
  EXPECT_EQ(ComputeStatistics({}).count, 0u);
  EXPECT_FALSE(ComputeStatistics({1e200}).IsFinite());
}

}  // namespace
}  // namespace trajlo::testing
