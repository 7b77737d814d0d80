// SPDX-License-Identifier: MIT
#include "core/odometry/health/inlier_watch.h"

#include <gtest/gtest.h>

namespace trajlo {
namespace {

/// The i-th window, 0.03 s after the one before.
WindowStatistics Window(int i, double share, double agreement = 0.97) {
  WindowStatistics window;
  window.end_ns = i * 30'000'000LL;
  window.points = 1000;
  window.inliers = static_cast<int>(1000.0 * share);
  window.agreement = agreement;
  return window;
}

TEST(InlierWatch, WhatIsFewDependsOnWhatIsUsual) {
  for (const double usual : {0.95, 0.6, 0.5}) {
    InlierWatch watch;
    for (int i = 0; i < 50; ++i) ASSERT_FALSE(watch.HasFew(Window(i, usual))) << i;
    EXPECT_FALSE(watch.HasFew(Window(50, 0.7 * usual)));
    EXPECT_TRUE(watch.HasFew(Window(51, 0.62 * usual)));
    EXPECT_FALSE(watch.HasFew(Window(52, usual)));
  }
}

TEST(InlierWatch, SomeAreFewAnywhere) {
  InlierWatch watch;
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(watch.HasFew(Window(i, 0.29)));
  EXPECT_FALSE(watch.HasFew(Window(50, 0.31)));
}

TEST(InlierWatch, ElsewhereSomethingElseBecomesUsual) {
  InlierWatch watch;
  int i = 0;
  while (i < 1000) ASSERT_FALSE(watch.HasFew(Window(i++, 0.95)));
  // From a hall into a wood.
  int few = 0;
  while (watch.HasFew(Window(i++, 0.55))) ++few;
  EXPECT_NEAR(0.03 * few, 5.0, 0.1);
  for (int k = 0; k < 1000; ++k) ASSERT_FALSE(watch.HasFew(Window(i++, 0.55)));
}

TEST(InlierWatch, FewAreThoseThatAgreeIfItLasts) {
  InlierWatch watch;
  int i = 0;
  while (i < 100) ASSERT_FALSE(watch.HasFew(Window(i++, 0.95)));
  // A jerk: half a second at most.
  while (i < 115) ASSERT_FALSE(watch.HasFew(Window(i++, 0.95, 0.5)));
  while (i < 150) ASSERT_FALSE(watch.HasFew(Window(i++, 0.95)));
  int unnoticed = 0;
  while (!watch.HasFew(Window(i++, 0.95, 0.75))) ++unnoticed;
  EXPECT_NEAR(0.03 * unnoticed, 0.5, 0.05);
  for (int k = 0; k < 1000; ++k) ASSERT_TRUE(watch.HasFew(Window(i++, 0.95, 0.75)));
}

TEST(InlierWatch, AWindowWithoutPointsHasFew) {
  InlierWatch watch;
  EXPECT_TRUE(watch.HasFew(WindowStatistics()));
}

}  // namespace
}  // namespace trajlo
