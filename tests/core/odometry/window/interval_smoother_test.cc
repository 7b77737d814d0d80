// SPDX-License-Identifier: MIT
#include "core/odometry/window/interval_smoother.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "core/odometry/window/push_segment.h"

namespace trajlo {
namespace {

constexpr std::int64_t kStep_ns = 30'000'000;
constexpr int kSegments = 3;  // of a window
constexpr int kReturn = 12;   // The first pose that is right again.
constexpr int kNewest = 15;   // The first pose of the present window.

/// Braked, climbing, and turned ever faster: no constant velocity.
SE3 Truth(int k) {
  const double t = 1e-9 * static_cast<double>(k * kStep_ns);
  return {so3::Exp({0.1 * t, 0.0, 3.0 * t * t}), {4.0 * t - 5.0 * t * t, 0.3, 2.0 * t * t * t}};
}

/// From pose 2 on nothing held the body, and it went on as it did.
SE3 Coasting(int k) {
  if (k <= 2) return Truth(k);
  return Truth(2) * se3::Exp((k - 2) * Minus(Truth(2), Truth(1)));
}

/// The window that begins at pose k.
Window WindowAt(int k, const std::function<SE3(int)>& pose) {
  Window window;
  window.begin_ns = k * kStep_ns;
  window.T_world_begin = pose(k);
  window.prior = AnchorOf(pose(k));
  for (int i = k; i < k + kSegments; ++i) {
    Segment segment;
    segment.cloud.begin_ns = i * kStep_ns;
    segment.cloud.end_ns = (i + 1) * kStep_ns;
    segment.T_world_end = pose(i + 1);
    window.segments.push_back(segment);
  }
  return window;
}

/// Poses `first` to `last` - 1 leave windows whose poses are those.
void Leave(int first, int last, const std::function<SE3(int)>& pose, IntervalSmoother* smoother) {
  for (int k = first; k < last; ++k) {
    const Window window = WindowAt(k, pose);
    smoother->AddPose(window, static_cast<unsigned>(k), k * Matrix6d::Identity());
    smoother->AddSegment(window.segments.front());
  }
}

double LargestError_m(const Window& window) {
  double largest = 0.0;
  for (int k = 0; k <= window.size(); ++k) {
    const auto n =
        static_cast<int>((k == 0 ? window.begin_ns : window.At(k - 1).cloud.end_ns) / kStep_ns);
    largest = std::max(largest, MeasureStep(window.Pose(k), Truth(n)).translation_m);
  }
  return largest;
}

TEST(IntervalSmoother, InterpolatesBetweenBothEndsWhatCoastedInBetween) {
  IntervalSmoother smoother;
  Leave(0, kReturn, Coasting, &smoother);
  Leave(kReturn, kNewest, Truth, &smoother);
  EXPECT_TRUE(smoother.has_jumped());
  EXPECT_EQ(smoother.segments(), kNewest);
  const Window newest = WindowAt(kNewest, Truth);
  const Window as_left = smoother.Join(newest);
  const Window interpolated = smoother.JoinInterpolated(newest);
  EXPECT_EQ(as_left.size(), kNewest + kSegments);
  EXPECT_GT(LargestError_m(as_left), 0.2);
  EXPECT_LT(LargestError_m(interpolated), 0.02);
  for (int k = 0; k <= interpolated.size(); ++k) {
    if (k > 0 && k < kReturn) continue;
    EXPECT_EQ(interpolated.Pose(k).t, as_left.Pose(k).t) << k;
  }
}

TEST(IntervalSmoother, BridgesAGap) {
  IntervalSmoother smoother;
  Leave(0, 5, Coasting, &smoother);
  smoother.AddPose(WindowAt(5, Coasting), 5, Matrix6d::Zero());
  smoother.AddGap(kReturn * kStep_ns);
  const Window newest = WindowAt(kReturn, Truth);
  EXPECT_FALSE(smoother.has_jumped());
  smoother.Meet(newest);
  EXPECT_TRUE(smoother.has_jumped());
  const Window joined = smoother.JoinInterpolated(newest);
  EXPECT_EQ(joined.size(), 6 + kSegments);
  EXPECT_LT(LargestError_m(joined), 0.02);
}

TEST(IntervalSmoother, HasNothingToEstimateWherePosesStay) {
  IntervalSmoother smoother;
  EXPECT_TRUE(smoother.is_empty());
  Leave(0, kReturn, Truth, &smoother);
  EXPECT_FALSE(smoother.is_empty());
  EXPECT_FALSE(smoother.has_jumped());
  EXPECT_NEAR(smoother.Duration_s(), 0.03 * kReturn, 1e-12);
}

TEST(IntervalSmoother, HandsOnEveryPoseOnceWithWhatBelongsToIt) {
  IntervalSmoother smoother;
  Leave(0, kNewest, Truth, &smoother);
  Window joined = smoother.Join(WindowAt(kNewest, Truth));
  for (Segment& segment : joined.segments) segment.T_world_end.t.z() += 1.0;
  smoother.SetPoses(joined);
  const LeavingPose oldest = smoother.TakeOldest({}, MotionPrior{{}});
  EXPECT_EQ(oldest.pose.t_ns, 0);
  EXPECT_EQ(oldest.pose.T_world_body.t, Truth(0).t);
  const std::vector<LeavingPose> rest = smoother.TakeAll();
  EXPECT_TRUE(smoother.is_empty());
  ASSERT_EQ(rest.size(), static_cast<std::size_t>(kNewest - 1));
  for (int k = 1; k < kNewest; ++k) {
    const LeavingPose& leaving = rest[static_cast<std::size_t>(k - 1)];
    EXPECT_EQ(leaving.pose.t_ns, k * kStep_ns);
    EXPECT_EQ(leaving.pose.flags, static_cast<unsigned>(k));
    EXPECT_EQ(leaving.covariance(0, 0), k);
    EXPECT_NEAR(leaving.pose.T_world_body.t.z(), Truth(k).t.z() + 1.0, 1e-12);
  }
}

/// As in a run, where a segment becomes the oldest of its window before it leaves. No point holds
/// the body: what is known of the third pose comes from the first one, by the motion prior.
TEST(IntervalSmoother, KeepsWhatIsKnownOfTheBeginWhenItsOldestPosesLeave) {
  const MotionPrior motion_prior{{}};
  const auto cloud = [](int k) {
    SegmentCloud segment;
    segment.begin_ns = k * kStep_ns;
    segment.end_ns = (k + 1) * kStep_ns;
    return segment;
  };
  IntervalSmoother smoother;
  Window window = MakeWindow(0, SE3());
  for (int k = 0; k < kReturn; ++k) {
    PushSegment(cloud(k), Vector6d::Zero(), Deskewing::kEstimated, &window);
    motion_prior.Apply(&window);
    if (k + 1 < kSegments) continue;
    smoother.AddPose(window, 0, Matrix6d::Zero());
    smoother.AddSegment(Marginalize({}, &window));
  }
  smoother.TakeOldest({}, motion_prior);
  smoother.TakeOldest({}, motion_prior);
  const Window joined = smoother.Join(window);
  EXPECT_EQ(joined.begin_ns, 2 * kStep_ns);
  ASSERT_EQ(joined.prior.poses(), 2);
  const std::vector<SE3> poses = joined.Poses();
  EXPECT_LT(joined.prior.Residual(poses).norm(), 1e-9);
  const Eigen::MatrixXd J = joined.prior.Jacobian(poses);
  const Eigen::MatrixXd information = J.transpose() * J;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(information);
  ASSERT_GT(eigen.eigenvalues()[0], 0.0);
  // The velocity at the start is known to 3 m/s and 3 rad/s.
  const Eigen::MatrixXd covariance = information.inverse();
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(std::sqrt(covariance(i, i)), 0.06 * 3.0, 0.01);
}

/// A pose that settles by a millimetre after it left takes the registration along; one that jumps
/// leaves it behind.
TEST(IntervalSmoother, TheRegistrationOfASegmentFollowsItsPoses) {
  for (const double moved_m : {1e-3, 1.0}) {
    Window window = WindowAt(0, Truth);
    RegistrationNormalEquations& registration = window.segments.front().registration;
    registration.H = 1e4 * Matrix12d::Identity();
    window.prior = {};
    IntervalSmoother smoother;
    smoother.AddPose(window, 0, Matrix6d::Zero());
    smoother.AddSegment(window.segments.front());
    Window next = WindowAt(1, Truth);
    next.T_world_begin.t.x() += moved_m;
    smoother.AddPose(next, 0, Matrix6d::Zero());
    smoother.AddSegment(next.segments.front());
    smoother.TakeOldest({}, MotionPrior{{}});
    const Window joined = smoother.Join(WindowAt(2, Truth));
    const std::vector<SE3> poses = joined.Poses();
    const Eigen::VectorXd pull =
        joined.prior.Jacobian(poses).transpose() * joined.prior.Residual(poses);
    // Where it settled, the points pull it back to where they had it.
    EXPECT_EQ(pull.size() > 0 && pull.norm() > 1.0, moved_m < 0.01) << pull.transpose();
  }
}

}  // namespace
}  // namespace trajlo
