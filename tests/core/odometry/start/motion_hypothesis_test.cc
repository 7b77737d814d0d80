// SPDX-License-Identifier: MIT
#include "core/odometry/start/motion_hypothesis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace trajlo {
namespace {

const Eigen::Vector3d kForward = Eigen::Vector3d::UnitX();

/// Boards across the way, as a sensor at rest sees them: each in both halves of the interval.
struct Boards {
  SegmentCloud interval;  ///< As MotionHypothesis takes it.

  Boards() { interval.lidar_origins_body_m = {Eigen::Vector3d::Zero()}; }

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
      interval.registration_points.push_back({p, alpha + step * static_cast<float>(i)});
    }
  }

  /// 40 m by 40 m of ground, 2 m below: 160 by 160 points in the first half, as many in the second.
  void AddGround() {
    for (int i = 0; i < 160; ++i) {
      for (int j = 0; j < 160; ++j) {
        const Eigen::Vector3f p(0.25F * static_cast<float>(i) - 20.0F,
                                0.25F * static_cast<float>(j) - 20.0F, -2.0F);
        interval.map_points.push_back({p, 0.25F});
        interval.registration_points.push_back({p, 0.75F});
      }
    }
  }

  MotionHypothesis Moving(double forward_m) const {
    ThreadPool threads(1);
    Vector6d tau = Vector6d::Zero();
    tau[0] = forward_m;
    return {interval, tau, {}, &threads};
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

TEST(MotionHypothesis, PlanesThatDoNotFaceADirectionSayNothingAlongIt) {
  Boards boards;
  boards.Add(10.0F, 0.0F, 0.6F, 0.01F);
  // A turn, so that the body's axes are not the world's.
  Vector6d tau = Vector6d::Zero();
  tau << 0.05, 0.02, 0.0, 0.0, 0.0, 0.02;
  ThreadPool threads(1);
  const MotionHypothesis hypothesis(boards.interval, tau, {}, &threads);
  const RegistrationNormalEquations all = hypothesis.Linearize({});
  ASSERT_GT(all.g.norm(), 0.0);
  const RegistrationNormalEquations forward = hypothesis.LinearizeAlong(kForward, {});
  EXPECT_LT((forward.H - all.H).norm(), 1e-9 * all.H.norm());
  EXPECT_LT((forward.g - all.g).norm(), 1e-9 * all.g.norm());

  // The boards do not face a direction 70 degrees off, but see some of the way along it.
  const Eigen::Vector3d aside(std::cos(1.22), std::sin(1.22), 0.0);
  Vector12d along = Vector12d::Zero(), across = Vector12d::Zero();
  along.segment<3>(6) = se3::Exp(tau).q.conjugate() * aside;
  across.segment<3>(6) = se3::Exp(tau).q.conjugate() * aside.cross(Eigen::Vector3d::UnitZ());
  ASSERT_GT(along.dot(all.H * along), 0.01 * across.dot(all.H * across));
  const RegistrationNormalEquations sideways = hypothesis.LinearizeAlong(aside, {});
  EXPECT_LT((sideways.H * along).norm(), 1e-9 * all.H.norm());
  EXPECT_NEAR(sideways.g.dot(along), 0.0, 1e-9 * all.g.norm());
  EXPECT_NEAR(across.dot(sideways.H * across), across.dot(all.H * across), 1e-9 * all.H.norm());
  EXPECT_NEAR(sideways.g.dot(across), all.g.dot(across), 1e-9 * all.g.norm());
  EXPECT_NEAR(sideways.cost, all.cost, 1e-9 * all.cost);
}

TEST(MotionHypothesis, AFewPointsOfTheGroundHoldWhatItTells) {
  Boards boards;
  boards.AddGround();
  boards.Add(10.0F, 0.0F, 0.6F, 0.01F);
  const auto telling_along = [&](const Eigen::Vector3d& direction) {
    return boards.Moving(0.0).TellingAlong(direction, boards.interval.registration_points);
  };
  const auto boards_among = [](const std::vector<SegmentPoint>& points) {
    return std::count_if(points.begin(), points.end(), [](const SegmentPoint& point) {
      return point.p_body_m.x() == 10.0F && point.p_body_m.z() > 0.0F;
    });
  };
  const std::vector<SegmentPoint> forward = telling_along(kForward);
  EXPECT_EQ(boards_among(forward), 25);
  EXPECT_GT(forward.size(), 2000u);
  EXPECT_LT(forward.size(), 3000u);
  // The ground faces upwards, and there are few others.
  EXPECT_EQ(telling_along(Eigen::Vector3d::UnitZ()).size(),
            boards.interval.registration_points.size());
  // A point without a plane may tell.
  boards.interval.registration_points.push_back({Eigen::Vector3f(100.0F, 0.0F, 0.0F), 0.9F});
  EXPECT_EQ(telling_along(kForward).size(), forward.size() + 1);
}

TEST(MotionHypothesis, OfNoPointsThereIsNothing) {
  const MotionHypothesis hypothesis = Boards().Moving(1.0);
  EXPECT_EQ(hypothesis.WithPlane(), 0);
  EXPECT_EQ(hypothesis.VotesAlong(kForward, 1.0), 0);
}

}  // namespace
}  // namespace trajlo
