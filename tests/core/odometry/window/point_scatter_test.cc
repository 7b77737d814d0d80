// SPDX-License-Identifier: MIT
#include "core/odometry/window/point_scatter.h"

#include <gtest/gtest.h>

#include "tests/support/test_window.h"

namespace trajlo {
namespace {

using testing::Random;

/// A window whose points are off their planes by noise of `noise_m`, and `outliers` of them by a
/// metre.
Window MakeNoisyWindow(double noise_m, double outliers = 0.0, int points_per_segment = 1000) {
  Window window = testing::MakeTestWindow(1, points_per_segment);
  Random random(2);
  for (int k = 0; k < window.size(); ++k) {
    Segment& segment = window.segments[static_cast<std::size_t>(k)];
    for (RegistrationPoint& point : segment.points) {
      const SE3 T = Interpolate(window.Pose(k), segment.T_world_end, point.alpha);
      const double off_m = random.Uniform(0, 1) < outliers ? 1.0 : random.Gaussian(noise_m);
      point.offset_m = point.normal_world.dot(T * point.p_body_m) + off_m;
    }
  }
  return window;
}

TEST(PointScatter, IsTheStandardDeviationOfNormalNoise) {
  for (const double noise_m : {0.01, 0.05, 0.2}) {
    EXPECT_NEAR(PointScatter(MakeNoisyWindow(noise_m)), noise_m, 0.1 * noise_m);
  }
}

TEST(PointScatter, HardlyFeelsOutliers) {
  EXPECT_NEAR(PointScatter(MakeNoisyWindow(0.05, 0.15)), 0.059, 0.008);
}

TEST(PointScatter, OnlyTheWeightedOneAsksForWeights) {
  Window window = MakeNoisyWindow(0.05);
  for (Segment& segment : window.segments) {
    for (RegistrationPoint& point : segment.points) point.weight = 0.25;
  }
  EXPECT_NEAR(PointScatter(window), 0.05, 0.005);
  EXPECT_DOUBLE_EQ(WeightedPointScatter(window), 0.5 * PointScatter(window));
}

TEST(PointScatter, IsUnknownWhereFewPointsTell) {
  EXPECT_EQ(PointScatter(MakeNoisyWindow(0.05, 0.0, 4)), 0.0);
  EXPECT_EQ(PointScatter(Window()), 0.0);
}

}  // namespace
}  // namespace trajlo
