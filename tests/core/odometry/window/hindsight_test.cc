// SPDX-License-Identifier: MIT
#include "core/odometry/window/hindsight.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <functional>
#include <vector>

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
void Leave(int first, int last, const std::function<SE3(int)>& pose, Hindsight* hindsight) {
  for (int k = first; k < last; ++k) {
    const Window window = WindowAt(k, pose);
    hindsight->AddPose(window, static_cast<unsigned>(k), k * Matrix6d::Identity());
    hindsight->AddSegment(window.segments.front());
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

TEST(Hindsight, InterpolatesBetweenBothEndsWhatCoastedInBetween) {
  Hindsight hindsight;
  Leave(0, kReturn, Coasting, &hindsight);
  Leave(kReturn, kNewest, Truth, &hindsight);
  EXPECT_TRUE(hindsight.has_jumped());
  EXPECT_EQ(hindsight.segments(), kNewest);
  const Window newest = WindowAt(kNewest, Truth);
  const Window as_left = hindsight.Join(newest);
  const Window interpolated = hindsight.JoinInterpolated(newest);
  EXPECT_EQ(as_left.size(), kNewest + kSegments);
  EXPECT_GT(LargestError_m(as_left), 0.2);
  EXPECT_LT(LargestError_m(interpolated), 0.02);
  for (int k = 0; k <= interpolated.size(); ++k) {
    if (k > 0 && k < kReturn) continue;
    EXPECT_EQ(interpolated.Pose(k).t, as_left.Pose(k).t) << k;
  }
}

TEST(Hindsight, BridgesAGap) {
  Hindsight hindsight;
  Leave(0, 5, Coasting, &hindsight);
  hindsight.AddPose(WindowAt(5, Coasting), 5, Matrix6d::Zero());
  hindsight.AddGap(kReturn * kStep_ns);
  const Window newest = WindowAt(kReturn, Truth);
  EXPECT_FALSE(hindsight.has_jumped());
  hindsight.Meet(newest);
  EXPECT_TRUE(hindsight.has_jumped());
  const Window joined = hindsight.JoinInterpolated(newest);
  EXPECT_EQ(joined.size(), 6 + kSegments);
  EXPECT_LT(LargestError_m(joined), 0.02);
}

TEST(Hindsight, HasNothingToEstimateWherePosesStay) {
  Hindsight hindsight;
  EXPECT_TRUE(hindsight.is_empty());
  Leave(0, kReturn, Truth, &hindsight);
  EXPECT_FALSE(hindsight.is_empty());
  EXPECT_FALSE(hindsight.has_jumped());
  EXPECT_NEAR(hindsight.Duration_s(), 0.03 * kReturn, 1e-12);
}

TEST(Hindsight, HandsOnEveryPoseOnceWithWhatBelongsToIt) {
  Hindsight hindsight;
  Leave(0, kNewest, Truth, &hindsight);
  Window joined = hindsight.Join(WindowAt(kNewest, Truth));
  for (Segment& segment : joined.segments) segment.T_world_end.t.z() += 1.0;
  hindsight.SetPoses(joined);
  const LeavingPose oldest = hindsight.TakeOldest({});
  EXPECT_EQ(oldest.pose.t_ns, 0);
  EXPECT_EQ(oldest.pose.T_world_body.t, Truth(0).t);
  const std::vector<LeavingPose> rest = hindsight.TakeAll();
  EXPECT_TRUE(hindsight.is_empty());
  ASSERT_EQ(rest.size(), static_cast<std::size_t>(kNewest - 1));
  for (int k = 1; k < kNewest; ++k) {
    const LeavingPose& leaving = rest[static_cast<std::size_t>(k - 1)];
    EXPECT_EQ(leaving.pose.t_ns, k * kStep_ns);
    EXPECT_EQ(leaving.pose.flags, static_cast<unsigned>(k));
    EXPECT_EQ(leaving.covariance(0, 0), k);
    EXPECT_NEAR(leaving.pose.T_world_body.t.z(), Truth(k).t.z() + 1.0, 1e-12);
  }
}

/// The oldest pose was held, and tied to the next one: so the next one is held when it has left.
TEST(Hindsight, KeepsWhatIsKnownOfTheBeginWhenItsOldestPoseLeaves) {
  Window window = WindowAt(0, Truth);
  SmoothnessTerm tie;
  tie.tau_expected = Minus(Truth(1), Truth(0));
  tie.sqrt_information.setConstant(100.0);
  window.segments.front().motion = tie;
  Hindsight hindsight;
  hindsight.AddPose(window, 0, Matrix6d::Zero());
  hindsight.AddSegment(window.segments.front());
  Leave(1, kReturn, Truth, &hindsight);
  hindsight.TakeOldest({});
  const Window joined = hindsight.Join(WindowAt(kReturn, Truth));
  EXPECT_EQ(joined.begin_ns, kStep_ns);
  EXPECT_EQ(joined.size(), kReturn - 1 + kSegments);
  const std::vector<SE3> poses = joined.Poses();
  EXPECT_LT(joined.prior.Residual(poses).norm(), 1e-6);
  const Eigen::MatrixXd J = joined.prior.Jacobian(poses).leftCols(6);
  const Matrix6d information = J.transpose() * J;
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(information);
  EXPECT_GT(eigen.eigenvalues()[0], 5e3);
}

}  // namespace
}  // namespace trajlo
