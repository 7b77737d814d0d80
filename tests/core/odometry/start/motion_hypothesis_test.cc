// SPDX-License-Identifier: MIT
#include "core/odometry/start/motion_hypothesis.h"

#include <gtest/gtest.h>

#include <vector>

namespace trajlo {
namespace {

const Eigen::Vector3d kForward = Eigen::Vector3d::UnitX();

/// Boards across the way, as a sensor at rest sees them: each in both halves of the interval.
struct Boards {
  SegmentCloud interval;
  std::vector<SegmentPoint> second_half;

  Boards() {
    interval.end_ns = 300'000'000;
    interval.lidar_origins_body_m = {Eigen::Vector3d::Zero()};
  }

  /// One of 1 m by 1 m. In the second half, its 25 points are seen from alpha on, so far apart.
  void Add(float x_m, float y_m, float alpha, float step) {
    for (int i = 0; i < 11; ++i) {
      for (int j = 0; j < 11; ++j) {
        const Eigen::Vector3f p(x_m, y_m + 0.1F * static_cast<float>(i),
                                0.1F * static_cast<float>(j));
        interval.map_points.push_back({p, 0.25F});
      }
    }
    for (int i = 0; i < 25; ++i) {
      const Eigen::Vector3f p(x_m, y_m + 0.3F + 0.1F * static_cast<float>(i % 5),
                              0.3F + 0.1F * static_cast<float>(i / 5));
      second_half.push_back({p, alpha + step * static_cast<float>(i)});
    }
  }

  MotionHypothesis Moving(double forward_m) const {
    ThreadPool threads(1);
    Vector6d tau = Vector6d::Zero();
    tau[0] = forward_m;
    return MotionHypothesis(interval, second_half, tau, {}, &threads);
  }
};

TEST(MotionHypothesis, PointsAgreeUnderTheRightMotionOnly) {
  Boards boards;
  boards.Add(10.0F, 0.0F, 0.6F, 0.01F);
  const MotionHypothesis right = boards.Moving(0.0);
  EXPECT_EQ(right.WithPlane(), 25);
  EXPECT_EQ(right.Agreeing(), 25);
  // Half a metre over the interval is 0.17 to 0.3 m since the first half.
  const MotionHypothesis wrong = boards.Moving(0.5);
  EXPECT_GT(wrong.WithPlane(), 0);
  EXPECT_EQ(wrong.Agreeing(), 0);
}

TEST(MotionHypothesis, APlaneTellsHowFarOneMovedAcrossIt) {
  Boards boards;
  boards.Add(10.0F, 0.0F, 0.6F, 0.01F);
  const MotionHypothesis hypothesis = boards.Moving(0.0);
  EXPECT_EQ(hypothesis.FacingAlong(kForward), 25);
  EXPECT_EQ(hypothesis.AgreeingAlong(kForward), 25);
  EXPECT_EQ(hypothesis.FacingAlong(Eigen::Vector3d::UnitY()), 0);
  EXPECT_EQ(hypothesis.AgreeingAlong(Eigen::Vector3d::UnitZ()), 0);
  EXPECT_EQ(hypothesis.VotesAlong(Eigen::Vector3d::UnitZ(), 10.0), 0);
}

TEST(MotionHypothesis, AMomentHasFewVotes) {
  Boards boards;
  boards.Add(12.0F, 2.0F, 0.6F, 0.0F);
  boards.Add(22.0F, 2.0F, 0.6F, 0.0F);
  EXPECT_EQ(boards.Moving(0.0).AgreeingAlong(kForward), 50);
  // All points are of one time, as those of a motion-corrected scan: there are no moments.
  EXPECT_EQ(boards.Moving(0.0).VotesAlong(kForward, 5.0), 16);
  // A third one is seen at 25 other times: the first two share the few votes of theirs.
  boards.Add(32.0F, 2.0F, 0.7F, 0.01F);
  EXPECT_LT(boards.Moving(0.0).VotesAlong(kForward, 5.0), 24);
}

TEST(MotionHypothesis, APlaceHasFewVotes) {
  Boards boards;
  boards.Add(12.0F, 2.0F, 0.6F, 0.01F);
  EXPECT_EQ(boards.Moving(0.0).VotesAlong(kForward, 5.0), 8);
  boards.Add(22.0F, 2.0F, 0.6F, 0.01F);
  EXPECT_EQ(boards.Moving(0.0).VotesAlong(kForward, 5.0), 16);
  EXPECT_EQ(boards.Moving(0.0).VotesAlong(kForward, 100.0), 8);
}

TEST(MotionHypothesis, OfNoPointsThereIsNothing) {
  const MotionHypothesis hypothesis = Boards().Moving(1.0);
  EXPECT_EQ(hypothesis.WithPlane(), 0);
  EXPECT_EQ(hypothesis.VotesAlong(kForward, 1.0), 0);
}

}  // namespace
}  // namespace trajlo
