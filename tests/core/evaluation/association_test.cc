// SPDX-License-Identifier: MIT
#include "core/evaluation/association.h"

#include <gmock/gmock.h>

#include "core/evaluation/completeness.h"
#include "core/evaluation/evaluation_error.h"
#include "core/scans/nanoseconds.h"
#include "tests/core/evaluation/synthetic_poses.h"

namespace trajlo::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Poses at x = 1, 2, 3, ... with the given stamps.
TimedPoses At(const std::vector<double>& t_s) {
  std::vector<double> x;
  for (std::size_t i = 0; i < t_s.size(); ++i) x.push_back(static_cast<double>(i + 1));
  TimedPoses poses = OnALine(x);
  for (std::size_t i = 0; i < t_s.size(); ++i) poses.t_ns[i] = Nanoseconds(t_s[i]);
  return poses;
}

/// The places of the truth that each pair has, for poses that stand on x.
std::vector<double> TruthX(const std::vector<PosePair>& pairs) {
  std::vector<double> x;
  for (const PosePair& pair : pairs) x.push_back(pair.truth.translation().x());
  return x;
}

std::string ErrorOf(const TimedPoses& estimate, const TimedPoses& truth,
                    const PoseAssociationOptions& options) {
  try {
    Associate(estimate, truth, 0, options);
  } catch (const EvaluationError& error) {
    return error.what();
  }
  return "";
}

PoseAssociationOptions Nearest10ms() {
  PoseAssociationOptions options;
  options.rule = AssociationRule::kNearest;
  return options;
}

TEST(Association, TheTruthIsInterpolatedOnTheShortestArc) {
  TimedPoses truth = OnALine({0.0, 1.0});
  truth.t_ns = {0, 40'000'000};
  truth.T_world_body[1].linear() =
      Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const std::vector<PosePair> pairs = Associate(At({0.01}), truth, 0, {});
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_NEAR(pairs[0].truth.translation().x(), 0.25, 1e-12);
  EXPECT_TRUE(pairs[0].truth.linear().isApprox(
      Eigen::AngleAxisd(0.25, Eigen::Vector3d::UnitZ()).toRotationMatrix(), 1e-12));
}

TEST(Association, NothingIsInterpolatedAcrossAGapOrBeyondTheEnds) {
  const TimedPoses truth = At({0.0, 0.02, 0.04, 0.5, 0.52});
  // Before, inside, in the gap, on a stamp at its end, behind.
  const TimedPoses estimate = At({-0.001, 0.01, 0.3, 0.5, 0.521});
  EXPECT_THAT(TruthX(Associate(estimate, truth, 0, {})), ElementsAre(1.5, 4.0));
  PoseAssociationOptions wide;
  wide.max_gap_s = 1.0;
  EXPECT_EQ(Associate(estimate, truth, 0, wide).size(), 3u);
}

TEST(Association, TheEstimateIsInterpolatedOnDemand) {
  PoseAssociationOptions options;
  options.rule = AssociationRule::kInterpolateEstimate;
  const std::vector<PosePair> pairs =
      Associate(At({0.0, 0.02, 0.04}), At({0.01, 0.03, 0.05}), 0, options);
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_NEAR(pairs[0].estimate.translation().x(), 1.5, 1e-12);
  EXPECT_EQ(pairs[1].truth.translation().x(), 2.0);
}

TEST(Association, TheNearestWinsAndTheFirstAtATie) {
  const TimedPoses truth = At({0.0, 0.25, 0.5, 1.0});
  PoseAssociationOptions options = Nearest10ms();
  options.max_time_difference_s = 1.0;
  EXPECT_THAT(TruthX(Associate(At({0.125, 0.3, 0.76}), truth, 0, options)),
              ElementsAre(1.0, 2.0, 4.0));
}

TEST(Association, ADifferenceOfExactlyTheToleranceIsKept) {
  EXPECT_EQ(Associate(At({0.01, 1.0}), At({0.0, 1.010000001}), 0, Nearest10ms()).size(), 1u);
}

TEST(Association, TheShorterTrajectoryIsWalkedSoAPoseOfTheLongerOneMayServeTwice) {
  PoseAssociationOptions options = Nearest10ms();
  options.max_time_difference_s = 1.0;
  const std::vector<PosePair> pairs = Associate(At({0.0, 5.0, 9.0}), At({4.8, 5.1}), 0, options);
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].index, 1u);
  EXPECT_EQ(pairs[1].index, 1u);
}

TEST(Association, OneToOneUsesNoPoseTwiceAndDropsADifferenceOfExactlyTheTolerance) {
  PoseAssociationOptions options;
  options.rule = AssociationRule::kOneToOne;
  options.max_time_difference_s = 0.25;
  // 4.9 is nearest to 5.0, but 5.05 is closer to it; 9.0 is as far away as the tolerance.
  const std::vector<PosePair> pairs =
      Associate(At({-0.1, 3.9, 4.05, 7.75}), At({0.1, 5.0, 9.0}), Nanoseconds(1.0), options);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].index, 2u);
  EXPECT_EQ(pairs[0].t_ns, Nanoseconds(5.05));
  EXPECT_EQ(pairs[0].estimate.translation().x(), 3.0);
  EXPECT_EQ(pairs[0].truth.translation().x(), 2.0);
}

TEST(Association, TheOffsetIsAddedToTheEstimate) {
  const std::vector<PosePair> pairs =
      Associate(At({0.0, 0.02}), At({100.0, 100.02}), Nanoseconds(100.0), Nearest10ms());
  EXPECT_THAT(TruthX(pairs), ElementsAre(1.0, 2.0));
  EXPECT_EQ(pairs[1].t_ns, Nanoseconds(100.02));
}

TEST(Association, WithoutStampsLinesArePairedAndMustBeAsMany) {
  TimedPoses a = At({0.0, 1.0, 2.0}), b = At({5.0, 6.0, 7.0});
  a.t_ns.clear();
  EXPECT_THAT(ErrorOf(a, b, {}), HasSubstr("--times"));
  b.t_ns.clear();
  EXPECT_THAT(TruthX(Associate(a, b, 0, {})), ElementsAre(1.0, 2.0, 3.0));
  b.T_world_body.pop_back();
  EXPECT_THAT(ErrorOf(a, b, {}), ::testing::AllOf(HasSubstr("3 poses"), HasSubstr("2")));
}

TEST(Association, WithoutPosesThatIsWhatIsSaid) {
  EXPECT_EQ(ErrorOf({}, At({5.0, 6.0}), {}), "the estimate has no poses");
  EXPECT_EQ(ErrorOf(At({5.0, 6.0}), {}, {}), "the ground truth has no poses");
}

TEST(Association, NoPairIsExplainedByTheTimeSpans) {
  const std::string apart = ErrorOf(At({5.0, 6.0}), At({50.0, 60.0}), {});
  EXPECT_THAT(apart, ::testing::AllOf(HasSubstr("5.000 to 6.000 s"), HasSubstr("50.000 to 60.000"),
                                      HasSubstr("--time_offset_s=45.000")));
  EXPECT_THAT(ErrorOf(At({5.0, 6.0}), At({1.6e9, 1.6e9 + 1}), {}), HasSubstr("same instant"));
  EXPECT_THAT(ErrorOf(At({5.0, 6.0}), At({4.5, 5.5}), Nearest10ms()),
              HasSubstr("--max_time_difference_s"));
  PoseAssociationOptions one_to_one;
  one_to_one.rule = AssociationRule::kOneToOne;
  EXPECT_THAT(ErrorOf(At({5.0, 6.0}), At({4.5, 5.5}), one_to_one),
              HasSubstr("--max_time_difference_s"));
  EXPECT_THAT(ErrorOf(At({5.0}), At({4.99, 5.1, 5.11, 5.12}), {}), HasSubstr("--max_gap_s"));
}

TEST(Completeness, CountsThePosesOfTheTruthThatTheEstimateCovers) {
  const TimedPoses truth = At({0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0});
  // Ends early, and has a hole from 3 to 5: 1, 2, 3, 5 are covered.
  const TimedPoses estimate = At({0.5, 1.4, 2.2, 3.0, 5.0, 5.9});
  EXPECT_DOUBLE_EQ(Completeness(estimate, truth, 0, 1.0), 0.4);
  EXPECT_DOUBLE_EQ(Completeness(estimate, truth, 0, 2.0), 0.5);
  EXPECT_DOUBLE_EQ(Completeness(estimate, truth, Nanoseconds(100.0), 1.0), 0.0);
}

}  // namespace
}  // namespace trajlo::testing
