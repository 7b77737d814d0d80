// SPDX-License-Identifier: MIT
#include "core/odometry/start/settle_poses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/odometry/first_poses.h"
#include "core/odometry/segments/segmenter.h"
#include "core/scans/nanoseconds.h"
#include "tests/support/synthetic_world.h"

namespace trajlo {
namespace {

constexpr std::size_t kSegments = 10;  ///< Of 0.03 s.

/// Goes ahead, and looks to and fro.
SE3 Walk(double t_s) {
  Vector6d tau = Vector6d::Zero();
  tau[0] = 1.5 * t_s;
  tau[5] = 0.1 * std::sin(2.0 * M_PI * 2.5 * t_s);
  return se3::Exp(tau);
}

struct Interval {
  std::vector<SegmentCloud> segments;
  std::vector<SE3> truth;

  explicit Interval(SE3 (*motion)(double t_s)) {
    testing::SyntheticWorld world;
    world.T_world_body = motion;
    Segmenter segmenter{SegmenterOptions()};
    for (int i = 0; i < 5; ++i) segmenter.AddScan(world.Sweep(i));
    while (segments.size() < kSegments) segments.push_back(segmenter.Next().value());
    const std::int64_t begin_ns = segments.front().begin_ns;
    truth = {SE3()};
    for (const SegmentCloud& segment : segments) {
      truth.push_back(motion(0.0).Inverse() * motion(Seconds(segment.end_ns - begin_ns)));
    }
  }

  /// What leads from the first pose to the last, at a constant twist.
  std::vector<SE3> ConstantTwist() const {
    const Vector6d tau = Minus(truth.back(), truth.front());
    std::vector<SE3> poses;
    for (std::size_t k = 0; k < truth.size(); ++k) {
      poses.push_back(se3::Exp(static_cast<double>(k) / static_cast<double>(kSegments) * tau));
    }
    return poses;
  }

  SettledPoses Settle(const std::vector<SE3>& start, bool is_coarse, int threads = 1) const {
    ThreadPool pool(threads);
    return SettlePoses(segments, start, is_coarse, {}, &pool);
  }

  StepSize LargestError(const std::vector<SE3>& poses) const {
    StepSize largest = {0.0, 0.0};
    for (std::size_t k = 0; k < truth.size(); ++k) {
      const Vector6d error = Minus(poses[k], truth[k]);
      largest.translation_m = std::max(largest.translation_m, error.head<3>().norm());
      largest.rotation_rad = std::max(largest.rotation_rad, error.tail<3>().norm());
    }
    return largest;
  }
};

TEST(SettlePoses, BringBothHalvesTogether) {
  const Interval walk(Walk);
  std::vector<SE3> poses = walk.truth;
  Vector6d error;
  error << 0.1, 0.05, -0.05, 0.01, -0.02, 0.04;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    poses[k] = Plus(poses[k], static_cast<double>(k) / static_cast<double>(kSegments) * error);
  }
  EXPECT_GT(walk.LargestError(poses).translation_m, 0.12);
  const StepSize left = walk.LargestError(walk.Settle(poses, false).poses);
  EXPECT_LT(left.translation_m, 0.05);
  EXPECT_LT(left.rotation_rad, 0.015);
}

/// Segment by segment, from a tracker and both halves.
TEST(FindFirstPoses, FindWhatAConstantTwistCannotExplain) {
  const Interval walk(Walk);
  const std::vector<SE3> twist = walk.ConstantTwist();
  EXPECT_FALSE(walk.LargestError(twist).IsWithin({0.05, 0.08}));
  ThreadPool threads(1);
  const Vector6d velocity = Minus(twist.back(), twist.front()) / 0.3;
  const std::vector<SE3> found =
      FindFirstPoses(walk.segments, velocity, {}, MakeWindowSolver, &threads);
  EXPECT_EQ(found.front().t, Eigen::Vector3d(0.0, 0.0, 0.0));
  EXPECT_TRUE(walk.LargestError(found).IsWithin({0.05, 0.045}));
}

TEST(SettlePoses, MostPointsAgreeWithTheTruth) {
  const Interval walk(Walk);
  const int at_truth = walk.Settle(walk.truth, false).agreeing;
  std::vector<SE3> elsewhere = walk.truth;
  for (std::size_t k = 0; k < elsewhere.size(); ++k) {
    elsewhere[k].t.y() += 0.3 * static_cast<double>(k);
  }
  EXPECT_GT(at_truth, walk.Settle(elsewhere, false).agreeing);
}

TEST(SettlePoses, StayWhereTheyAreRight) {
  const Interval rest([](double) { return SE3(); });
  EXPECT_TRUE(rest.LargestError(rest.Settle(rest.truth, false).poses).IsWithin({0.01, 0.002}));
}

TEST(SettlePoses, DoNotDependOnThreads) {
  const Interval walk(Walk);
  const std::vector<SE3> twist = walk.ConstantTwist();
  const SettledPoses one = walk.Settle(twist, true, 1), two = walk.Settle(twist, true, 2);
  EXPECT_EQ(one.agreeing, two.agreeing);
  for (std::size_t k = 0; k < one.poses.size(); ++k) {
    EXPECT_EQ(one.poses[k].t, two.poses[k].t);
    EXPECT_EQ(one.poses[k].q.coeffs(), two.poses[k].q.coeffs());
  }
}

}  // namespace
}  // namespace trajlo
