// SPDX-License-Identifier: MIT
#include "core/odometry/health/belief.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace trajlo {
namespace {

/// Whether a correction of the newest pose is a jump, if its segment lasts so long.
bool Jumps(double correction_m, double duration_s) {
  Window window;
  window.segments.resize(1);
  window.segments[0].cloud.end_ns = std::llround(1e9 * duration_s);
  WindowStatistics statistics;
  statistics.correction.translation_m = correction_m;
  return HasJumped(statistics, window);
}

TEST(Belief, APoseJumpsIfItMovesFartherThanTenGAndThanAPointMayBeOffItsPlane) {
  EXPECT_FALSE(Jumps(0.1, 0.03));
  EXPECT_FALSE(Jumps(0.19, 0.03)) << "more than 10 g, but an error of velocities may be as large";
  EXPECT_TRUE(Jumps(0.21, 0.03));
  // 10 g move a body by 1 m in 0.1 s.
  EXPECT_FALSE(Jumps(0.9, 0.1));
  EXPECT_TRUE(Jumps(1.1, 0.1));
}

TEST(Belief, WhatIsPutBackIsNotBelieved) {
  Window window;
  window.segments.resize(1);
  window.segments[0].registration.H.setIdentity();
  const std::vector<SE3> predicted = {SE3(), se3::Exp(Vector6d::Constant(0.1))};
  Revert(predicted, &window);
  EXPECT_FALSE(window.is_believed);
  EXPECT_EQ(window.Pose(1).t, predicted[1].t);
  EXPECT_TRUE(window.segments[0].registration.H.isZero());
}

}  // namespace
}  // namespace trajlo
