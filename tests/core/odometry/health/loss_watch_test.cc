// SPDX-License-Identifier: MIT
#include "core/odometry/health/loss_watch.h"

#include <gtest/gtest.h>

namespace trajlo {
namespace {

constexpr std::int64_t kWindow_ns = 30'000'000;

WindowStatistics Window(int index, int inliers, unsigned flags = 0) {
  WindowStatistics window;
  window.end_ns = index * kWindow_ns;
  window.points = 100;
  window.inliers = inliers;
  window.flags = flags;
  return window;
}

/// A window of many inliers that settles, or does not.
WindowStatistics Settling(int index, bool settles) {
  WindowStatistics window = Window(index, 95);
  window.restless_rounds = settles ? 2 : 5;
  return window;
}

TEST(LossWatch, IsNotLostByAShortLackOfInliers) {
  LossWatch watch;
  for (int i = 0; i < 300; ++i) {
    const bool blind = i % 34 != 0;  // 0.99 s at a time.
    EXPECT_FALSE(watch.Update(Window(i, blind ? 2 : 90))) << i;
  }
}

TEST(LossWatch, IsLostSinceTheInliersWentAway) {
  // A quarter is what a wrong map explains by chance.
  for (const int few : {2, 25}) {
    LossWatch watch;
    for (int i = 0; i < 50; ++i) ASSERT_FALSE(watch.Update(Window(i, 90)));
    for (int i = 50; i < 84; ++i) ASSERT_FALSE(watch.Update(Window(i, few))) << i;
    const auto since_ns = watch.Update(Window(84, few));
    ASSERT_TRUE(since_ns) << few;
    EXPECT_EQ(*since_ns, 50 * kWindow_ns);
    EXPECT_FALSE(watch.Update(Window(85, 90)));
  }
}

TEST(LossWatch, IsLostWhenHardlyAnyWindowSettlesThoughInliersAreMany) {
  for (const bool is_reverted : {false, true}) {
    LossWatch watch;
    // Every seventh settles: no unbroken spell, and yet lost after the span.
    int first_lost = -1;
    for (int i = 0; i < 200 && first_lost < 0; ++i) {
      const bool settles = i % 7 == 6;
      const auto since_ns = watch.Update(is_reverted ? Window(i, 95, settles ? 0u : +kFlagReverted)
                                                     : Settling(i, settles));
      if (!since_ns) continue;
      first_lost = i;
      EXPECT_LE(*since_ns, kWindow_ns);
    }
    EXPECT_NEAR(first_lost, 101, 1);
  }
}

/// Scans that are a second apart rarely settle, at the right place, too.
TEST(LossWatch, AFewWindowsHaveNoShare) {
  LossWatch watch;
  int first_lost = -1;
  for (int i = 0; i < 60 && first_lost < 0; ++i) {
    WindowStatistics window = Settling(i, false);
    window.end_ns = i * std::int64_t{1'000'000'000};
    if (watch.Update(window)) first_lost = i;
  }
  EXPECT_EQ(first_lost, 20);
}

TEST(LossWatch, AsksForMoreWindowsThatSettleWherePosesHaveAFlag) {
  for (const unsigned flags :
       {0u, +kFlagNotConverged, +kFlagDegenerate, +kFlagGap, +kFlagFewInliers}) {
    LossWatch watch;
    bool is_lost = false;
    for (int i = 0; i < 200; ++i) {
      WindowStatistics window = Settling(i, i % 5 < 2);
      window.flags = flags;
      is_lost |= watch.Update(window).has_value();
    }
    EXPECT_EQ(is_lost, flags == kFlagGap || flags == kFlagFewInliers) << flags;
  }
}

/// Flags alone are no loss: windows that settle may leave a direction open for ever.
TEST(LossWatch, IsNotLostWhileWindowsSettleWhateverTheirFlags) {
  LossWatch watch;
  for (int i = 0; i < 300; ++i) {
    WindowStatistics window = Settling(i, i % 5 > 1);
    window.flags = kFlagDegenerate;
    EXPECT_FALSE(watch.Update(window));
  }
}

/// Nor while predictions are far off: so it is in fast turns.
TEST(LossWatch, IsNotLostWhileHalfOfTheWindowsSettle) {
  LossWatch watch;
  for (int i = 0; i < 300; ++i) {
    WindowStatistics window = Settling(i, i % 2 == 0);
    window.correction.rotation_rad = 0.1;
    EXPECT_FALSE(watch.Update(window));
  }
}

/// Whether a window settled does not depend on the tolerance or the rounds that the options give.
/// Rounds with wider kernels are still on the way to the planes.
TEST(LossWatch, RoundsWithWiderKernelsDoNotMakeAWindowRestless) {
  WindowStatistics window;
  window.restless_rounds = 6;
  EXPECT_TRUE(window.IsRestless());
  window.widened_rounds = 2;
  EXPECT_FALSE(window.IsRestless());
  window.restless_rounds = 7;
  EXPECT_TRUE(window.IsRestless());
}

TEST(LossWatch, AWindowIsRestlessWhileStepsAreLarge) {
  SolverOptions options;
  options.step_tolerance = {1e-9, 1e-9};
  WindowStatistics window;
  SolveSummary solve;
  solve.iterations = 1;
  for (const double step_m : {0.1, 0.05, 0.02, 0.004, 0.003, 0.002}) {
    solve.step = {step_m, 0.0};
    window.Add(solve, options);
  }
  // The third step lets 8 mm expect, the fourth one 0.8 mm.
  EXPECT_EQ(window.restless_rounds, 3);
  EXPECT_EQ(window.rounds, 6);
  EXPECT_FALSE(window.has_converged);
}

/// What the points of a long segment saw on the way lies on no straight motion: its steps stay
/// larger, and mean less. Those of a motion-corrected scan saw it at once.
TEST(LossWatch, LongSegmentsSettleWithLargerSteps) {
  const auto is_restless = [](double segment_s, bool is_instant) {
    SegmentCloud cloud;
    cloud.end_ns = static_cast<std::int64_t>(1e9 * segment_s);
    cloud.is_instant = is_instant;
    WindowStatistics window;
    window.restless = RestlessStep(cloud);
    SolveSummary solve;
    solve.iterations = 1;
    for (int round = 0; round < 6; ++round) {
      solve.step = {0.02, 0.004};
      window.Add(solve, SolverOptions());
    }
    return window.IsRestless();
  };
  EXPECT_TRUE(is_restless(0.01, false));
  EXPECT_TRUE(is_restless(0.03, false));
  EXPECT_FALSE(is_restless(0.1, false));
  EXPECT_TRUE(is_restless(0.1, true));
}

}  // namespace
}  // namespace trajlo
