// SPDX-License-Identifier: MIT
#include "core/evaluation/evaluation.h"

#include <gmock/gmock.h>

#include "core/evaluation/evaluation_error.h"
#include "core/scans/nanoseconds.h"
#include "tests/core/evaluation/synthetic_poses.h"

namespace trajlo::testing {
namespace {

using ::testing::HasSubstr;

TEST(Evaluation, APerfectEstimateHasNoErrors) {
  EvaluationOptions options;
  options.relative = {{1.0, DeltaUnit::kMetres}, {1.0, DeltaUnit::kSeconds}};
  const Evaluation e = Evaluate(SmoothPoses(1.0, 0.1, 100), SmoothPoses(0.0, 0.05, 400), options);
  EXPECT_EQ(e.pairs.size(), 100u);
  EXPECT_LT(e.absolute.full.max, 1e-6);
  EXPECT_LT(e.relative[0].statistics.full.max, 1e-6);
  EXPECT_GT(e.relative[1].pieces, 80u);
  EXPECT_NEAR(e.duration_s, 9.9, 1e-9);
  EXPECT_NEAR(e.completeness, 9.9 / 20.0, 0.01);
  EXPECT_EQ(e.paired_share, 1.0);
  EXPECT_THAT(e.divergence_reason,
              ::testing::AllOf(HasSubstr("covers"), HasSubstr("--min_completeness=0")));
  EXPECT_TRUE(e.incomplete);
}

TEST(Evaluation, AnExtrinsicTakesBodyPosesToTheFrameOfTheTruth) {
  const Eigen::Affine3d T_body_truth =
      Eigen::Translation3d(0.3, -0.2, 0.5) * Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitX());
  TimedPoses truth = SmoothPoses(0.0, 0.05, 200);
  EvaluationOptions options;
  const TimedPoses estimate = truth;
  truth = InFrame(truth, T_body_truth);
  EXPECT_GT(Evaluate(estimate, truth, options).absolute.translation_m.rmse, 0.1);
  options.T_body_truth = T_body_truth;
  EXPECT_LT(Evaluate(estimate, truth, options).absolute.full.rmse, 1e-6);
}

TEST(Evaluation, KittiErrorsOfAScaleErrorAreThatError) {
  TimedPoses truth, estimate;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Translation3d place(2.0 * i, 0.0, 0.0);
    truth.T_world_body.emplace_back(
        place * Eigen::AngleAxisd(1e-3, Eigen::Vector3d::UnitX()));  // Not a placeholder.
    estimate.T_world_body.push_back(truth.T_world_body.back());
    estimate.T_world_body.back().translation() *= 1.01;
  }
  EvaluationOptions options;
  options.alignment.kind = AlignmentKind::kNone;
  const Evaluation e = Evaluate(estimate, truth, options);
  ASSERT_TRUE(e.kitti);
  // The last frame is the first one beyond the length: up to 2 m, 2 % of 100 m, more.
  EXPECT_NEAR(e.kitti->translation_percent, 1.0, 0.02);
  EXPECT_NEAR(e.kitti->rotation_deg_per_m, 0.0, 1e-9);
  EXPECT_EQ(e.kitti->per_length[7].segments, 60u);
  options.alignment.first_seconds = 5.0;
  EXPECT_THROW(Evaluate(estimate, truth, options), EvaluationError);
}

TEST(Evaluation, TheFirstPoseCannotBeAlignedToAPrism) {
  TimedPoses truth = SmoothPoses(0.0, 0.05, 100);
  for (Eigen::Affine3d& T : truth.T_world_body) T.linear().setIdentity();
  EvaluationOptions options;
  options.alignment.kind = AlignmentKind::kOrigin;
  EXPECT_THROW(Evaluate(SmoothPoses(0.0, 0.1, 50), truth, options), EvaluationError);
  options.truth_orientation = TruthOrientation::kUse;
  EXPECT_TRUE(Evaluate(SmoothPoses(0.0, 0.1, 50), truth, options).has_orientation);
}

/// A straight drive at 10 m/s with a slight roll, and an estimate that is off by up to 2 mm.
void StraightDrive(TimedPoses* estimate, TimedPoses* truth) {
  for (int i = 0; i < 100; ++i) {
    const double t_s = 0.1 * i;
    truth->t_ns.push_back(Nanoseconds(t_s));
    truth->T_world_body.emplace_back(
        Eigen::Translation3d(10.0 * t_s, 0.001 * std::sin(t_s), 0.0) *
        Eigen::AngleAxisd(0.02 * std::sin(t_s), Eigen::Vector3d::UnitX()));
    estimate->t_ns.push_back(truth->t_ns.back());
    estimate->T_world_body.push_back(truth->T_world_body.back());
    estimate->T_world_body.back().pretranslate(
        Eigen::Vector3d(0.0, 0.002 * std::sin(2.0 * t_s), 0.002 * std::sin(t_s)));
  }
}

TEST(Evaluation, ATurnThatTheAlignmentLeavesOpenIsNoRotationError) {
  TimedPoses estimate, truth;
  StraightDrive(&estimate, &truth);
  EvaluationOptions options;
  const Evaluation e = Evaluate(estimate, truth, options);
  EXPECT_GT(e.absolute.rotation_deg.rmse, 10.0);  // And yet each attitude is right.
  EXPECT_FALSE(e.rotation_determined);
  EXPECT_THAT(e.warnings, ::testing::ElementsAre(::testing::AllOf(
                              HasSubstr("ATE [deg] says little"), HasSubstr("RPE [deg]"),
                              HasSubstr("--alignment=origin"))));
  options.alignment.kind = AlignmentKind::kOrigin;
  const Evaluation by_origin = Evaluate(estimate, truth, options);
  EXPECT_LT(by_origin.absolute.rotation_deg.rmse, 0.01);
  EXPECT_TRUE(by_origin.rotation_determined);
  EXPECT_THAT(by_origin.warnings, ::testing::IsEmpty());
}

TEST(Evaluation, ARestingBodyHasNoAbsoluteRotationError) {
  TimedPoses estimate = SmoothPoses(0.0, 0.1, 100), truth = estimate;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    estimate.T_world_body[i].translation() *= 1e-3;
    truth.T_world_body[i].translation() = 1e-6 * truth.T_world_body[99 - i].translation();
  }
  const Evaluation e = Evaluate(estimate, truth, {});
  EXPECT_GT(e.absolute.rotation_deg.rmse, 1.0);
  EXPECT_FALSE(e.rotation_determined);
}

TEST(Evaluation, RotationErrorsOfAPathThatFixesThemAreBelieved) {
  TimedPoses estimate = SmoothPoses(1.0, 0.1, 100);
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    estimate.T_world_body[i].translation().x() += 0.01 * std::sin(0.3 * static_cast<double>(i));
    estimate.T_world_body[i].rotate(
        Eigen::AngleAxisd(0.01 * std::sin(0.2 * static_cast<double>(i)), Eigen::Vector3d::UnitY()));
  }
  const Evaluation e = Evaluate(estimate, SmoothPoses(0.0, 0.05, 400), {});
  EXPECT_TRUE(e.rotation_determined);
  EXPECT_THAT(e.warnings, ::testing::IsEmpty());
}

TEST(Evaluation, AnotherFrameOfTheTruthIsSuspected) {
  const TimedPoses estimate = SmoothPoses(1.0, 0.1, 100);
  TimedPoses truth = SmoothPoses(0.0, 0.05, 400);
  for (Eigen::Affine3d& T : truth.T_world_body) {
    T.rotate(Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitZ()));
  }
  EXPECT_THAT(Evaluate(estimate, truth, {}).warnings,
              ::testing::ElementsAre(::testing::AllOf(HasSubstr("the same turn of 90 deg"),
                                                      HasSubstr("--T_body_truth"))));
}

TEST(Evaluation, QuaternionsWithTheScalarFirstAreSuspected) {
  TimedPoses truth = SmoothPoses(0.0, 0.05, 400);
  for (Eigen::Affine3d& T : truth.T_world_body) {
    const Eigen::Quaterniond q(T.linear());
    T.linear() = Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()).matrix();  // w x y z as x y z w.
  }
  EXPECT_THAT(Evaluate(SmoothPoses(1.0, 0.1, 100), truth, {}).warnings,
              ::testing::ElementsAre(HasSubstr("w first")));
}

TEST(Evaluation, OfEurocsFormatQuaternionsWithTheScalarLastAreSuspected) {
  TimedPoses truth = SmoothPoses(0.0, 0.05, 400);
  truth.format = TrajectoryFormat::kEuroc;
  for (Eigen::Affine3d& T : truth.T_world_body) {
    const Eigen::Quaterniond q(T.linear());
    T.linear() = Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w()).matrix();  // x y z w as w x y z.
  }
  EXPECT_THAT(Evaluate(SmoothPoses(1.0, 0.1, 100), truth, {}).warnings,
              ::testing::ElementsAre(::testing::AllOf(HasSubstr("seem to have w last"),
                                                      HasSubstr("EuRoC's csv has qw qx qy qz"))));
}

TEST(Evaluation, AnotherUnitOfTheTruthIsSuspected) {
  TimedPoses truth = SmoothPoses(0.0, 0.05, 400);
  for (Eigen::Affine3d& T : truth.T_world_body) T.translation() *= 1000.0;
  EXPECT_THAT(Evaluate(SmoothPoses(1.0, 0.1, 100), truth, {}).warnings,
              ::testing::Contains(HasSubstr("about 1000 times as large")));
  EvaluationOptions options;
  options.alignment.kind = AlignmentKind::kSim3;
  EXPECT_THAT(Evaluate(SmoothPoses(1.0, 0.1, 100), truth, options).warnings,
              ::testing::Not(::testing::Contains(HasSubstr("times as large"))));
}

TEST(Evaluation, AMirroredTruthIsSuspected) {
  TimedPoses truth = SmoothPoses(0.0, 0.05, 400);
  const Eigen::Vector3d mirror(1.0, -1.0, 1.0);
  for (Eigen::Affine3d& T : truth.T_world_body) {
    T.translation().y() *= -1.0;
    T.linear() = mirror.asDiagonal() * T.linear() * mirror.asDiagonal();
  }
  EXPECT_THAT(Evaluate(SmoothPoses(1.0, 0.1, 100), truth, {}).warnings,
              ::testing::Contains(HasSubstr("mirror image")));
}

TEST(Evaluation, AMirroredFlatPathIsSuspectedByItsAttitudes) {
  for (const double tilt_rad : {0.0, 0.4}) {
    TimedPoses estimate, truth;
    for (int i = 0; i < 100; ++i) {
      const double yaw_rad = 0.05 * i;
      const Eigen::Vector3d place(0.1 * i, std::sin(yaw_rad), 0.0);
      const Eigen::Quaterniond q =
          Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(tilt_rad * std::sin(0.7 * i), Eigen::Vector3d::UnitY());
      estimate.t_ns.push_back(Nanoseconds(0.1 * i));
      estimate.T_world_body.emplace_back(Eigen::Translation3d(place) * q);
      truth.t_ns.push_back(estimate.t_ns.back());
      // As the axes x, -y, z have it.
      truth.T_world_body.emplace_back(Eigen::Translation3d(place.x(), -place.y(), 0.0) *
                                      Eigen::Quaterniond(q.w(), -q.x(), q.y(), -q.z()));
    }
    EXPECT_THAT(Evaluate(estimate, truth, {}).warnings,
                ::testing::ElementsAre(HasSubstr("left-handed axes")));
  }
}

TEST(TimeOffset, OfTwoClocksIsFound) {
  for (const double clock_s : {0.137, -0.4321}) {
    const TimedPoses estimate = SmoothPoses(2.0, 0.1, 100, clock_s);
    EvaluationOptions options;
    options.estimate_time_offset = true;
    const Evaluation e = Evaluate(estimate, SmoothPoses(0.0, 0.01, 2000), options);
    EXPECT_NEAR(e.time_offset_s, -clock_s, 1e-4);
    EXPECT_LT(e.absolute.translation_m.rmse, 1e-3);
    EXPECT_GT(e.estimated_time_offset->rmse_around_m, 0.1);
    EXPECT_THAT(e.warnings, ::testing::IsEmpty());
  }
}

TEST(TimeOffset, IsFoundByTheRuleThatPairsThePoses) {
  // Of a truth at 1 Hz, whose straight lines the body leaves, and which has no gap below 0.3 s.
  const TimedPoses estimate = SmoothPoses(2.0, 0.02, 800, 0.137);
  for (const double max_gap_s : {0.0, 0.3}) {
    EvaluationOptions options;
    options.estimate_time_offset = true;
    options.association.rule = AssociationRule::kInterpolateEstimate;
    options.association.max_gap_s = max_gap_s;
    const Evaluation e = Evaluate(estimate, SmoothPoses(0.0, 1.0, 21), options);
    EXPECT_NEAR(e.time_offset_s, -0.137, 1e-3) << max_gap_s;
    EXPECT_LT(e.estimated_time_offset->rmse_m, 1e-3);
  }
}

TEST(TimeOffset, WithFewPairsIsNoCandidate) {
  // Moments of a truth with gaps: few offsets keep all pairs, others only those that fit by chance.
  TimedPoses estimate = SmoothPoses(0.0, 1.0, 20), truth, all = SmoothPoses(0.0, 0.005, 4000);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double into_second_s = std::fmod(0.005 * static_cast<double>(i) + 0.5, 1.0) - 0.5;
    if (std::abs(into_second_s) > 0.011 && i > 400) continue;
    truth.t_ns.push_back(all.t_ns[i]);
    truth.T_world_body.push_back(all.T_world_body[i]);
  }
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    estimate.T_world_body[i].translation().x() += 0.05 * std::sin(5.0 * static_cast<double>(i));
  }
  TimeOffsetOptions options;
  options.reach_s = 0.3;
  const TimeOffset found = EstimateTimeOffset(estimate, truth, options);
  EXPECT_LT(std::abs(found.offset_s), 0.012);  // There all pairs are, and nowhere else.
  EXPECT_LE(found.rmse_m, found.rmse_around_m);
}

TEST(TimeOffset, IsFoundWhereTheScaleDiffers) {
  TimedPoses truth = SmoothPoses(0.0, 0.01, 2000);
  for (Eigen::Affine3d& T : truth.T_world_body) T.translation() *= 2.0;
  for (const AlignmentKind kind : {AlignmentKind::kSim3, AlignmentKind::kScale}) {
    EvaluationOptions options;
    options.estimate_time_offset = true;
    options.alignment.kind = kind;
    EXPECT_NEAR(Evaluate(SmoothPoses(2.0, 0.1, 100, 0.137), truth, options).time_offset_s, -0.137,
                1e-3);
  }
}

TEST(TimeOffset, AtTheEndOfTheRangeIsNotBelieved) {
  EvaluationOptions options;
  options.estimate_time_offset = true;
  options.time_offset_reach_s = 0.1;
  const Evaluation e =
      Evaluate(SmoothPoses(2.0, 0.1, 100, 0.3), SmoothPoses(0.0, 0.01, 2000), options);
  EXPECT_THAT(e.warnings, ::testing::Contains(::testing::AllOf(
                              HasSubstr("end of the range"), HasSubstr("--time_offset_reach_s"))));
  options.time_offset_s = -0.25;
  EXPECT_NEAR(Evaluate(SmoothPoses(2.0, 0.1, 100, 0.3), SmoothPoses(0.0, 0.01, 2000), options)
                  .time_offset_s,
              -0.3, 1e-4);
}

TEST(TimeOffset, OfUniformMotionIsUnknown) {
  TimedPoses truth, estimate;
  for (int i = 0; i < 3000; ++i) {
    // Uniform on a circle: the alignment undoes any offset.
    const double angle = 0.01 * i;
    truth.t_ns.push_back(Nanoseconds(0.01 * i));
    truth.T_world_body.emplace_back(
        Eigen::Translation3d(std::cos(angle), std::sin(angle), 0.01 * (i % 2)));
    if (i < 500 || i > 2500 || i % 10 != 0) continue;
    estimate.t_ns.push_back(truth.t_ns.back());
    estimate.T_world_body.push_back(truth.T_world_body.back());
    estimate.T_world_body.back().translation().z() += 0.2 * ((i / 10) % 2);
  }
  const TimeOffset offset = EstimateTimeOffset(estimate, truth, {});
  EXPECT_THAT(offset.warning, HasSubstr("hardly depends"));
}

TEST(Divergence, FollowsItsRules) {
  const DivergenceOptions rules;
  const auto reason = [&](double rmse, double path_m, double completeness) {
    return DivergenceReason(ComputeStatistics({rmse}), path_m, completeness, rules);
  };
  EXPECT_EQ(reason(1.0, 20.0, 0.9), "");
  EXPECT_THAT(reason(2.1, 20.0, 0.9), HasSubstr("10 % of the path"));
  EXPECT_EQ(reason(0.4, 1.0, 0.9), "");  // Hardly moved.
  EXPECT_THAT(reason(0.1, 20.0, 0.49), HasSubstr("49.0 %"));
  EXPECT_TRUE(IsIncomplete(ComputeStatistics({0.1}), 20.0, 0.49, rules));
  EXPECT_FALSE(IsIncomplete(ComputeStatistics({2.1}), 20.0, 0.49, rules));  // Diverged as well.
  EXPECT_FALSE(IsIncomplete(ComputeStatistics({0.1}), 20.0, 0.51, rules));
  EXPECT_THAT(reason(1e200, 1e300, 1.0), HasSubstr("not finite"));
  DivergenceOptions absolute;
  absolute.ate_m = 5.0;
  EXPECT_THAT(DivergenceReason(ComputeStatistics({6.0}), 1000.0, 1.0, absolute),
              HasSubstr("above 5 m"));
  EXPECT_THAT(DivergenceRule(absolute), HasSubstr("above 5 m"));
}

}  // namespace
}  // namespace trajlo::testing
