// SPDX-License-Identifier: MIT
#include "core/evaluation/coverage.h"

#include <gmock/gmock.h>

#include "core/evaluation/evaluation.h"
#include "tests/core/evaluation/synthetic_poses.h"

namespace trajlo::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// 8 s of an estimate at 50 Hz.
TimedPoses Estimate() { return SmoothPoses(0.0, 0.02, 401); }

Evaluation Compare(const TimedPoses& truth, AssociationRule rule = AssociationRule::kInterpolate) {
  EvaluationOptions options;
  options.association.rule = rule;
  return Evaluate(Estimate(), truth, options);
}

TimedPoses Joined(TimedPoses first, const TimedPoses& second) {
  first.t_ns.insert(first.t_ns.end(), second.t_ns.begin(), second.t_ns.end());
  first.T_world_body.insert(first.T_world_body.end(), second.T_world_body.begin(),
                            second.T_world_body.end());
  return first;
}

TEST(Coverage, ASliverOfTruthIsTold) {
  const Evaluation e = Compare(SmoothPoses(7.7, 0.01, 31));
  EXPECT_NEAR(e.covered_share, 0.3 / 8.0, 0.01);
  EXPECT_THAT(e.warnings, ElementsAre(HasSubstr("only 0.3 s of the 8.0 s of the estimate")));
}

TEST(Coverage, WhatLiesInAPauseOfTheTruthIsNotCompared) {
  const TimedPoses ends = Joined(SmoothPoses(0.0, 0.01, 101), SmoothPoses(7.0, 0.01, 101));
  const Evaluation e = Compare(ends);
  EXPECT_NEAR(e.covered_share, 0.25, 0.01);
  EXPECT_THAT(e.warnings, ElementsAre(HasSubstr("only 2.0 s of the 8.0 s")));
}

TEST(Coverage, TruthThatBeginsLaterOrEndsEarlierIsUsual) {
  for (const double begin_s : {0.0, 1.0, 3.0}) {
    const Evaluation e = Compare(SmoothPoses(begin_s, 0.01, 501));
    EXPECT_NEAR(e.covered_share, 5.0 / 8.0, 0.01);
    EXPECT_THAT(e.warnings, IsEmpty());
  }
}

TEST(Coverage, SparseTruthCoversWhatLiesBetweenItsPoses) {
  const TimedPoses sparse = SmoothPoses(0.1, 1.5, 6);
  for (const auto rule : {AssociationRule::kInterpolateEstimate, AssociationRule::kNearest}) {
    const Evaluation e = Compare(sparse, rule);
    EXPECT_GT(e.covered_share, 0.9);
    EXPECT_THAT(e.warnings, IsEmpty());
  }
}

TEST(Coverage, WithoutStampsAllIsCompared) {
  TimedPoses lines = Estimate();
  lines.t_ns.clear();
  EXPECT_EQ(Evaluate(lines, lines, {}).covered_share, 1.0);
}

}  // namespace
}  // namespace trajlo::testing
