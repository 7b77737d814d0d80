// SPDX-License-Identifier: MIT
#include "core/simulation/faults.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace trajlo::simulation {
namespace {

constexpr std::int64_t kStart = 1'000'000'000'000;
constexpr std::int64_t kPeriod = 100'000'000;

SimulatedScan MakeScan(int lidar_id, std::int64_t index, std::size_t points = 4) {
  SimulatedScan s;
  s.index = index;
  s.period_ns = kPeriod;
  s.true_start_ns = kStart + index * kPeriod;
  s.sweep_start_ns = s.true_start_ns;
  s.scan.lidar_id = lidar_id;
  s.scan.stamp_ns = s.sweep_start_ns;
  s.scan.points.resize(points);
  for (std::size_t i = 0; i < points; ++i) {
    s.scan.points[i].t_ns = s.sweep_start_ns + static_cast<std::int64_t>(i);
  }
  return s;
}

/// What is left of a stream of scans.
std::vector<SimulatedScan> Through(const FaultConfig& config, int count, int lidar_id = 0) {
  FaultInjector faults(config, 5, kStart);
  std::vector<SimulatedScan> kept;
  for (int i = 0; i < count; ++i) {
    SimulatedScan scan = MakeScan(lidar_id, i);
    if (faults.Apply(&scan)) kept.push_back(scan);
  }
  return kept;
}

TEST(Faults, NoneIsTheDefault) {
  const std::vector<SimulatedScan> kept = Through(FaultConfig{}, 50);
  ASSERT_EQ(kept.size(), 50U);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const SimulatedScan expected = MakeScan(0, static_cast<std::int64_t>(i));
    EXPECT_EQ(kept[i].scan.stamp_ns, expected.scan.stamp_ns);
    EXPECT_EQ(kept[i].scan.points[1].t_ns, expected.scan.points[1].t_ns);
    EXPECT_TRUE(kept[i].scan.points[1].xyz_m.allFinite());
  }
}

TEST(Faults, ScansAreDroppedAtTheAskedRate) {
  FaultConfig config;
  config.dropped_scan_fraction = 0.3;
  EXPECT_NEAR(static_cast<double>(Through(config, 2000).size()), 1400.0, 95.0);
}

TEST(Faults, ScansComeTwiceAtTheAskedRate) {
  FaultConfig config;
  EXPECT_FALSE(FaultInjector(config, 5, kStart).Repeats(MakeScan(0, 0)));
  config.repeated_scan_fraction = 0.2;
  const FaultInjector faults(config, 5, kStart);
  int repeated = 0;
  for (int i = 0; i < 2000; ++i) repeated += faults.Repeats(MakeScan(0, i)) ? 1 : 0;
  EXPECT_NEAR(repeated, 400, 75);
}

TEST(Faults, PointsBecomeNanAtTheAskedRate) {
  FaultConfig config;
  config.nan_point_fraction = 0.1;
  FaultInjector faults(config, 5, kStart);
  SimulatedScan scan = MakeScan(0, 0, 20000);
  ASSERT_TRUE(faults.Apply(&scan));
  int nans = 0;
  for (const LidarPoint& point : scan.scan.points) nans += std::isnan(point.xyz_m.x()) ? 1 : 0;
  EXPECT_NEAR(nans, 2000, 200);
  EXPECT_EQ(scan.scan.points.size(), 20000U);
}

TEST(Faults, ADuplicateStampIsThatOfTheScanBeforeAndMovesThePointTimes) {
  FaultConfig config;
  config.duplicate_stamp_fraction = 1.0;
  const std::vector<SimulatedScan> kept = Through(config, 3);
  EXPECT_EQ(kept[0].scan.stamp_ns, kStart);
  EXPECT_EQ(kept[1].scan.stamp_ns, kStart);
  EXPECT_EQ(kept[2].scan.stamp_ns, kStart);
  EXPECT_EQ(kept[2].scan.points[3].t_ns, kStart + 3);
  EXPECT_EQ(kept[2].sweep_start_ns, kStart);
  EXPECT_EQ(kept[2].true_start_ns, kStart + 2 * kPeriod);
}

TEST(Faults, ABackwardStampLiesBeforeThatOfTheScanBefore) {
  FaultConfig config;
  config.backward_stamp_fraction = 1.0;
  config.backward_step_s = 0.02;
  const std::vector<SimulatedScan> kept = Through(config, 3);
  EXPECT_EQ(kept[1].scan.stamp_ns, kStart - 20'000'000);
  EXPECT_EQ(kept[2].scan.stamp_ns, kStart - 40'000'000);
}

TEST(Faults, JitterHasTheAskedSpread) {
  FaultConfig config;
  config.stamp_jitter_s = 0.002;
  double squares = 0.0;
  const std::vector<SimulatedScan> kept = Through(config, 2000);
  for (const SimulatedScan& s : kept) {
    const auto error = static_cast<double>(s.scan.stamp_ns - s.true_start_ns);
    EXPECT_EQ(s.scan.points[0].t_ns, s.scan.stamp_ns);
    squares += error * error;
  }
  EXPECT_NEAR(std::sqrt(squares / 2000.0), 2e6, 1e5);
}

TEST(Faults, OneLidarFallsSilentForAWhile) {
  FaultConfig config;
  config.silent_lidar = 1;
  config.silent_from_s = 1.0;
  config.silent_until_s = 2.0;
  EXPECT_EQ(Through(config, 50, 0).size(), 50U);
  const std::vector<SimulatedScan> kept = Through(config, 50, 1);
  EXPECT_EQ(kept.size(), 40U);
  EXPECT_EQ(kept[9].index, 9);
  EXPECT_EQ(kept[10].index, 20);
}

TEST(Faults, APauseTakesTheScansOfAllLidars) {
  FaultConfig config;
  config.pause_from_s = 1.0;
  config.pause_s = 2.0;
  for (const int lidar : {0, 1}) {
    const std::vector<SimulatedScan> kept = Through(config, 50, lidar);
    ASSERT_EQ(kept.size(), 30U);
    EXPECT_EQ(kept[9].index, 9);
    EXPECT_EQ(kept[10].index, 30);
  }
}

TEST(Faults, ACoveredLidarSeesTheCover) {
  FaultConfig config;
  config.cover_from_s = 0.1;
  config.cover_s = 0.1;
  FaultInjector faults(config, 5, kStart);
  for (int i = 0; i < 3; ++i) {
    SimulatedScan scan = MakeScan(0, i);
    for (LidarPoint& point : scan.scan.points) point.xyz_m = {3.0F, 4.0F, 0.0F};
    ASSERT_TRUE(faults.Apply(&scan));
    for (const LidarPoint& point : scan.scan.points) {
      EXPECT_FLOAT_EQ(point.xyz_m.norm(), i == 1 ? 0.6F : 5.0F);
    }
  }
}

TEST(Faults, EndOfSweepStampsLeaveThePointTimesRight) {
  FaultConfig config;
  config.end_of_sweep_stamps = true;
  const std::vector<SimulatedScan> kept = Through(config, 3);
  EXPECT_EQ(kept[2].scan.stamp_ns, kStart + 3 * kPeriod);
  EXPECT_EQ(kept[2].sweep_start_ns, kStart + 2 * kPeriod);
  EXPECT_EQ(kept[2].scan.points[0].t_ns, kStart + 2 * kPeriod);
}

TEST(Faults, OneFaultDoesNotChangeAnother) {
  FaultConfig config;
  config.dropped_scan_fraction = 0.2;
  std::vector<std::int64_t> a;
  for (const SimulatedScan& s : Through(config, 200)) a.push_back(s.index);
  config.stamp_jitter_s = 0.001;
  config.duplicate_stamp_fraction = 0.1;
  config.nan_point_fraction = 0.1;
  std::vector<std::int64_t> b;
  for (const SimulatedScan& s : Through(config, 200)) b.push_back(s.index);
  EXPECT_EQ(a, b);
}

}  // namespace
}  // namespace trajlo::simulation
