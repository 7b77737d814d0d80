// SPDX-License-Identifier: MIT
#include "core/evaluation/error_causes.h"

#include <gmock/gmock.h>

#include "core/evaluation/evaluation.h"
#include "core/scans/nanoseconds.h"
#include "tests/core/evaluation/synthetic_poses.h"

namespace trajlo::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kBegin_s = 100.0;

/// 20 s of an estimate at 50 Hz, a little off; its clock is ahead of the truth's.
TimedPoses Estimate(double clock_s = 0.0) {
  TimedPoses poses = SmoothPoses(kBegin_s, 0.02, 1001, clock_s);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses.T_world_body[i].translation().x() += 0.001 * std::sin(13.0 * static_cast<double>(i));
  }
  return poses;
}

std::vector<std::string> Warnings(const TimedPoses& estimate, const TimedPoses& truth,
                                  const EvaluationOptions& options = {}) {
  return Evaluate(estimate, truth, options).warnings;
}

TEST(ErrorCauses, DenseTruthOfTheSameClockIsBelieved) {
  EXPECT_THAT(Warnings(Estimate(), SmoothPoses(kBegin_s, 0.01, 2001)), IsEmpty());
  EXPECT_THAT(Warnings(Estimate(), SmoothPoses(kBegin_s, 0.02, 1001)), IsEmpty());
}

TEST(ErrorCauses, SparseTruthIsNotInterpolatedInSilence) {
  const TimedPoses truth = SmoothPoses(kBegin_s, 0.5, 41);
  EXPECT_THAT(Warnings(Estimate(), truth), Contains(HasSubstr("interpolate_estimate")));
  EvaluationOptions options;
  options.association.rule = AssociationRule::kInterpolateEstimate;
  EXPECT_THAT(Warnings(Estimate(), truth, options), IsEmpty());
}

TEST(ErrorCauses, TheStraightLineIsLeftByTheSagittaOfTheArc) {
  // On a circle of 1 m radius, chords of 0.2 rad leave it by 5 mm at most, by 3.65 mm in RMS.
  TimedPoses circle;
  for (int i = 0; i <= 1000; ++i) {
    circle.t_ns.push_back(Nanoseconds(0.01 * i));
    circle.T_world_body.emplace_back(
        Eigen::Translation3d(std::cos(0.01 * i), std::sin(0.01 * i), 0.0));
  }
  TimedPoses sparse;
  for (std::size_t i = 0; i < circle.size(); i += 20) {
    sparse.t_ns.push_back(circle.t_ns[i]);
    sparse.T_world_body.push_back(circle.T_world_body[i]);
  }
  const double sagitta_m = 1.0 - std::cos(0.1);
  // sagitta (1 - x²) over the chord, with 19 of 20 stamps between its ends: RMS sqrt(8/15 · 20/19).
  EXPECT_NEAR(StraightLineError_m(circle, sparse, 0, 1.0),
              std::sqrt(8.0 / 15.0 * 20.0 / 19.0) * sagitta_m, 2e-6);
  EXPECT_EQ(StraightLineError_m(circle, sparse, 0, 0.1), 0.0);
  EXPECT_EQ(StraightLineError_m(circle, circle, 0, 1.0), 0.0);
}

TEST(ErrorCauses, ClocksThatDifferAreSuspected) {
  const TimedPoses truth = SmoothPoses(kBegin_s - 1.0, 0.01, 2201);
  for (const double clock_s : {0.2, -0.05}) {
    const Evaluation evaluation = Evaluate(Estimate(clock_s), truth, {});
    EXPECT_THAT(evaluation.warnings, Contains(HasSubstr("--estimate_time_offset")));
    EXPECT_NEAR(ExplainByClocks(evaluation.pairs).offset_s, -clock_s, 0.1 * std::abs(clock_s));
  }
  EvaluationOptions options;
  options.estimate_time_offset = true;
  EXPECT_THAT(Warnings(Estimate(0.05), truth, options), IsEmpty());
}

TEST(ErrorCauses, OfNoPairsThereIsNone) { EXPECT_EQ(ExplainByClocks({}).share, 0.0); }

}  // namespace
}  // namespace trajlo::testing
