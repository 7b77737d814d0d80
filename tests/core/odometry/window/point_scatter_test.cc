// SPDX-License-Identifier: MIT
#include "core/odometry/window/point_scatter.h"

#include <gtest/gtest.h>

#include "tests/support/test_window.h"

namespace trajlo {
namespace {

using testing::MakeNoisyWindow;

TEST(PointScatter, IsTheStandardDeviationOfNormalNoise) {
  for (const double noise_m : {0.01, 0.05, 0.2}) {
    EXPECT_NEAR(PointScatter(MakeNoisyWindow(noise_m)), noise_m, 0.1 * noise_m);
  }
}

TEST(PointScatter, HardlyFeelsOutliers) {
  EXPECT_NEAR(PointScatter(MakeNoisyWindow(0.05, 0.15)), 0.059, 0.008);
}

TEST(PointScatter, AsksForNoWeights) {
  Window window = MakeNoisyWindow(0.05);
  for (Segment& segment : window.segments) {
    for (RegistrationPoint& point : segment.points) point.weight = 0.25;
  }
  EXPECT_NEAR(PointScatter(window), 0.05, 0.005);
}

TEST(PointScatter, IsUnknownWhereFewPointsTell) {
  EXPECT_EQ(PointScatter(MakeNoisyWindow(0.05, 0.0, 4)), 0.0);
  EXPECT_EQ(PointScatter(Window()), 0.0);
}

}  // namespace
}  // namespace trajlo
