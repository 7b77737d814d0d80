// SPDX-License-Identifier: MIT
#include "core/io/inspection/sweep_times.h"

#include <gmock/gmock.h>

namespace trajlo {
namespace {

constexpr std::int64_t kMs = 1'000'000;

/// A sweep of 90 ms that begins `phase_ns` after an even 100 ms.
LidarScan Sweep(int index, std::int64_t phase_ns) {
  LidarScan scan;
  scan.stamp_ns = 1'000'000 * kMs + index * 100 * kMs + phase_ns;
  for (int i = 0; i < 10; ++i) {
    scan.points.push_back({{1, 0, 0}, 0.0F, scan.stamp_ns + i * 10 * kMs});
  }
  return scan;
}

TEST(SweepTimes, SaysHowSweepsLieToTheirStampsAndToEachOther) {
  SweepTimes sweeps;
  for (int i = 0; i < 5; ++i) sweeps.Add(Sweep(i, 0), 0);
  const auto summary = sweeps.Summarise(0.1);
  ASSERT_TRUE(summary);
  EXPECT_NEAR(summary->span_s, 0.09, 1e-12);
  EXPECT_NEAR(summary->pause_s, 0.01, 1e-12);
  EXPECT_NEAR(summary->stamp_after_first_s, 0.0, 1e-12);
  EXPECT_NEAR(summary->stamp_after_last_s, -0.09, 1e-12);
}

TEST(SweepTimes, ScansWithoutTimesHaveNoSweeps) {
  SweepTimes sweeps;
  LidarScan scan = Sweep(0, 0);
  scan.has_point_times = false;
  sweeps.Add(scan, 0);
  EXPECT_FALSE(sweeps.Summarise(0.1));
}

TEST(PhaseOf, IsCountedFromTheSweepBefore) {
  SweepTimes first, second, early;
  for (int i = 0; i < 9; ++i) {
    first.Add(Sweep(i, 0), 0);
    second.Add(Sweep(i, 37 * kMs), 0);
    // About in step: it must not flip between the ends of the period.
    early.Add(Sweep(i, i % 2 == 0 ? -kMs : kMs), 0);
  }
  const auto phase = PhaseOf(second.begins_ns(), first.begins_ns(), 0.1);
  ASSERT_TRUE(phase);
  EXPECT_NEAR(phase->after_first_lidar_s, 0.037, 1e-9);
  EXPECT_NEAR(phase->spread_s, 0.0, 1e-9);
  const auto about_zero = PhaseOf(early.begins_ns(), first.begins_ns(), 0.1);
  ASSERT_TRUE(about_zero);
  EXPECT_NEAR(about_zero->spread_s, 0.002, 1e-9);
}

}  // namespace
}  // namespace trajlo
