// SPDX-License-Identifier: MIT
#include "core/evaluation/alignment.h"

#include <gmock/gmock.h>

#include "core/evaluation/evaluation_error.h"
#include "tests/core/evaluation/synthetic_poses.h"

namespace trajlo::testing {
namespace {

/// Pairs whose estimate is the truth seen from another world, in another scale.
struct Moved {
  Eigen::Matrix3d R = Eigen::AngleAxisd(2.5, Eigen::Vector3d(1, -2, 0.5).normalized()).matrix();
  Eigen::Vector3d t{10.0, -20.0, 3.0};
  double scale = 1.0;

  std::vector<PosePair> Pairs(const TimedPoses& truth) const {
    std::vector<PosePair> pairs;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const Eigen::Affine3d& T = truth.T_world_body[i];
      Eigen::Affine3d estimate = Eigen::Affine3d::Identity();
      estimate.linear() = R.transpose() * T.linear();
      estimate.translation() = R.transpose() * (T.translation() - t) / scale;
      pairs.push_back({truth.t_ns[i], i, estimate, T});
    }
    return pairs;
  }
};

double LargestError(const Alignment& alignment, const std::vector<PosePair>& pairs) {
  double largest = 0.0;
  for (const PosePair& pair : pairs) {
    largest = std::max(
        largest,
        ((alignment * pair.estimate).matrix() - pair.truth.matrix()).cwiseAbs().maxCoeff());
  }
  return largest;
}

TEST(Alignment, EveryKindUndoesItsOwnTransformation) {
  const TimedPoses truth = SmoothPoses(0.0, 0.1, 50);
  const Moved rigid;
  for (const AlignmentKind kind :
       {AlignmentKind::kSe3, AlignmentKind::kOrigin, AlignmentKind::kSim3}) {
    const std::vector<PosePair> pairs = rigid.Pairs(truth);
    const Alignment alignment = ComputeAlignment(pairs, {kind});
    EXPECT_LT(LargestError(alignment, pairs), 1e-12);
    EXPECT_NEAR(alignment.scale, 1.0, 1e-12);
  }
  Moved similar;
  similar.scale = 2.5;
  const std::vector<PosePair> pairs = similar.Pairs(truth);
  EXPECT_LT(LargestError(ComputeAlignment(pairs, {AlignmentKind::kSim3}), pairs), 1e-12);
  const Alignment scale = ComputeAlignment(pairs, {AlignmentKind::kScale});
  EXPECT_NEAR(scale.scale, 2.5, 1e-12);
  EXPECT_TRUE(scale.R.isIdentity(0.0));
  EXPECT_TRUE(scale.t.isZero(0.0));
}

TEST(Alignment, AMirroredEstimateIsTurnedAndNotMirrored) {
  std::vector<PosePair> pairs = Moved().Pairs(SmoothPoses(0.0, 0.1, 50));
  for (PosePair& pair : pairs) pair.estimate.translation().x() *= -1.0;
  EXPECT_NEAR(ComputeAlignment(pairs, {}).R.determinant(), 1.0, 1e-12);
}

TEST(Alignment, TheFirstPairsOrSecondsCanDecideAlone) {
  std::vector<PosePair> pairs = Moved().Pairs(SmoothPoses(0.0, 0.1, 50));
  // From 2 s on the estimate is wrong.
  for (std::size_t i = 20; i < pairs.size(); ++i) pairs[i].estimate.translation().x() += 7.0;
  AlignmentOptions by_pairs, by_seconds;
  by_pairs.first_pairs = 20;
  by_seconds.first_seconds = 1.9;
  for (const AlignmentOptions& options : {by_pairs, by_seconds}) {
    const Alignment alignment = ComputeAlignment(pairs, options);
    EXPECT_EQ(alignment.pairs_used, 20u);
    EXPECT_LT(LargestError(alignment, {pairs.begin(), pairs.begin() + 20}), 1e-12);
  }
}

TEST(Alignment, PlacesThatLeaveTheRotationOpenAreRefused) {
  const auto pairs_of = [](const TimedPoses& truth) { return Moved().Pairs(truth); };
  EXPECT_THROW(ComputeAlignment(pairs_of(OnALine({3.0, 3.0, 3.0})), {}), EvaluationError);
  EXPECT_THROW(ComputeAlignment(pairs_of(OnALine({0.0, 1.0, 5.0, 9.0})), {}), EvaluationError);
  EXPECT_THROW(ComputeAlignment(pairs_of(OnALine({0.0, 1.0})), {}), EvaluationError);
  const std::vector<PosePair> line = pairs_of(OnALine({0.0, 1.0, 5.0, 9.0}));
  EXPECT_LT(LargestError(ComputeAlignment(line, {AlignmentKind::kOrigin}), line), 1e-12);
}

TEST(Alignment, KnowsHowWellItFixesTheRotation) {
  // A rectangle of 40 m by 2 m, and errors of 0.1 m along z.
  TimedPoses truth = OnALine({-20.0, -20.0, 20.0, 20.0});
  for (const int i : {0, 2}) truth.T_world_body[i].translation().y() = 1.0;
  for (const int i : {1, 3}) truth.T_world_body[i].translation().y() = -1.0;
  std::vector<PosePair> pairs = Moved().Pairs(truth);
  // Neither a shift nor a turn undoes these.
  for (const int i : {0, 3}) pairs[i].truth.translation().z() += 0.1;
  for (const int i : {1, 2}) pairs[i].truth.translation().z() -= 0.1;
  const Alignment alignment = ComputeAlignment(pairs, {});
  EXPECT_NEAR(std::abs(alignment.rotation_axes(0, 0)), 1.0, 1e-6);
  EXPECT_NEAR(alignment.rotation_sigma_rad[0], 0.1 / 1.0, 1e-4);
  EXPECT_NEAR(alignment.rotation_sigma_rad[1], 0.1 / 20.0, 1e-4);
  EXPECT_NEAR(*RotationSigmaDeg(alignment), 5.73, 0.01);
  EXPECT_FALSE(RotationSigmaDeg(ComputeAlignment(pairs, {AlignmentKind::kOrigin})));
  EXPECT_FALSE(RotationSigmaDeg(ComputeAlignment(pairs, {AlignmentKind::kScale})));
}

}  // namespace
}  // namespace trajlo::testing
