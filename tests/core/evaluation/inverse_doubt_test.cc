// SPDX-License-Identifier: MIT
#include "core/evaluation/inverse_doubt.h"

#include <gmock/gmock.h>

#include "core/evaluation/evaluation.h"
#include "core/evaluation/pose_errors.h"
#include "tests/core/evaluation/synthetic_poses.h"

namespace trajlo::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TimedPoses Inverted(TimedPoses poses) {
  for (Eigen::Affine3d& T : poses.T_world_body) T = RigidInverse(T);
  return poses;
}

TEST(JudgeInverse, PosesOfTheWorldInTheBodyAreSuspectedAndNothingElse) {
  const TimedPoses run = SmoothPoses(0.0, 0.02, 401);
  EXPECT_THAT(Evaluate(run, run, {}).warnings, IsEmpty());
  EXPECT_THAT(Evaluate(run, Inverted(run), {}).warnings,
              ElementsAre(HasSubstr("poses of the world in the body")));
}

TEST(JudgeInverse, AFlatPathIsNotTakenForAMirroredOne) {
  TimedPoses drive;
  for (int i = 0; i <= 400; ++i) {
    const double t_s = 0.02 * i;
    drive.t_ns.push_back(Nanoseconds(t_s));
    drive.T_world_body.emplace_back(
        Eigen::Translation3d(3.0 * t_s, 5.0 * std::sin(0.5 * t_s), 0.0) *
        Eigen::AngleAxisd(0.8 * std::sin(0.5 * t_s + 0.3), Eigen::Vector3d::UnitZ()));
  }
  const auto warnings = Evaluate(drive, Inverted(drive), {}).warnings;
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("poses of the world in the body")));
}

TEST(JudgeInverse, WhatRestsFitsTheInverseOfACircleAndProvesNothing) {
  std::vector<PosePair> pairs;
  for (int i = 0; i < 300; ++i) {
    const Eigen::AngleAxisd turn(0.02 * i, Eigen::Vector3d::UnitZ());
    PosePair pair;
    pair.truth = turn * Eigen::Translation3d(5.0, 0.0, 0.0);
    pair.estimate = Eigen::Translation3d(1e-3 * std::sin(0.7 * i), 1e-3 * std::cos(1.3 * i), 0.0) *
                    Eigen::AngleAxisd(0.0, Eigen::Vector3d::UnitZ());
    pairs.push_back(pair);
  }
  EXPECT_EQ(JudgeInverse(pairs, false), "");
}

}  // namespace
}  // namespace trajlo::testing
