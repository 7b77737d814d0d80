// SPDX-License-Identifier: MIT
#include "core/odometry/health/support.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

/// A body at rest that sees `all` points, of which `on_plane` lie on the floor they belong to, and
/// `off_plane` a metre above it.
Window Standing(int all, int on_plane, int off_plane) {
  Window window;
  window.segments.resize(1);
  Segment& segment = window.segments[0];
  segment.cloud.end_ns = 30'000'000;
  segment.cloud.registration_points.resize(static_cast<std::size_t>(all));
  for (int i = 0; i < on_plane + off_plane; ++i) {
    const Eigen::Vector3d p(0.1 * i, 2.0, i < on_plane ? 0.0 : 1.0);
    segment.points.push_back({p, 0.5, Eigen::Vector3d::UnitZ(), 0.0, 1.0, 0.0});
  }
  return window;
}

bool IsNewestUnsupported(const Window& window) {
  return IsUnsupported(window, window.segments.back());
}

TEST(Support, PointsThatSeeANewPartOfTheWorldLeaveABodySupported) {
  // A fast turn: one point in twenty is where the map has been, and agrees with it.
  EXPECT_FALSE(IsNewestUnsupported(Standing(1000, 50, 0)));
  EXPECT_FALSE(IsNewestUnsupported(Standing(1000, 50, 40)));
}

TEST(Support, PointsThatDisagreeWithTheirPlanesHoldNothing) {
  EXPECT_TRUE(IsNewestUnsupported(Standing(1000, 300, 400)));
}

TEST(Support, AHandfulOfPointsHoldsNothing) {
  EXPECT_TRUE(IsNewestUnsupported(Standing(10, 10, 0)));
  EXPECT_TRUE(IsNewestUnsupported(Standing(0, 0, 0)));
}

TEST(Support, PointsOfSegmentsThatTheyDoNotHoldLoseTheirWeight) {
  Window window = Standing(1000, 300, 400);
  Window held = Standing(1000, 400, 300);
  window.segments.push_back(held.segments[0]);
  EXPECT_TRUE(SilenceUnsupported(&window));
  for (const RegistrationPoint& point : window.segments[0].points) EXPECT_EQ(point.weight, 0.0);
  for (const RegistrationPoint& point : window.segments[1].points) EXPECT_EQ(point.weight, 1.0);
  EXPECT_FALSE(SilenceUnsupported(&window)) << "they have none left";
  EXPECT_FALSE(SilenceUnsupported(&held));
}

TEST(Support, TheWatchIsBlindWhenThePredictionIsTooUncertainToStartFrom) {
  SupportWatch watch;
  Vector6d density;
  density << 3, 3, 3, 0.3, 0.3, 0.3;
  watch.Begin(0);
  EXPECT_FALSE(watch.IsBlind(10'000'000'000, density)) << "nothing was found yet";
  watch.Supported(1'000'000'000);
  // Three standard deviations are a metre where t³ = 1 / 9 s³.
  EXPECT_FALSE(watch.IsBlind(1'475'000'000, density));
  EXPECT_TRUE(watch.IsBlind(1'485'000'000, density));
  // And 0.45 rad of a body that turns fast where t³ = 3 / 4 0.15² s³.
  density << 0.1, 0.1, 0.1, 4, 4, 4;
  EXPECT_FALSE(watch.IsBlind(1'250'000'000, density));
  EXPECT_TRUE(watch.IsBlind(1'260'000'000, density));
}

TEST(UnseenSigma, IsThatOfWhiteNoiseIntegratedTwice) {
  testing::Random random(3);
  constexpr int kSteps = 200, kTrials = 2000;
  constexpr double kDensity = 2.5, kDuration_s = 1.7, kStep_s = kDuration_s / kSteps;
  double sum_of_squares = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    double velocity = 0.0, position = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      position += kStep_s * velocity;
      velocity += random.Gaussian(std::sqrt(kDensity * kStep_s));
    }
    sum_of_squares += position * position;
  }
  EXPECT_NEAR(std::sqrt(sum_of_squares / kTrials) / UnseenSigma(kDensity, kDuration_s), 1.0, 0.06);
}

}  // namespace
}  // namespace trajlo
