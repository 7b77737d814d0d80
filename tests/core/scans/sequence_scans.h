// SPDX-License-Identifier: MIT
// Scans with given stamps, and what a ScanSequencer makes of them.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

#include "core/scans/scan_sequencer.h"

namespace trajlo::testing {

inline constexpr std::int64_t kMs = 1'000'000;
inline constexpr std::int64_t kPeriod = 100 * kMs;
inline constexpr std::int64_t kSecond = 1'000 * kMs;
inline constexpr std::int64_t kHour = 3600 * kSecond;
inline constexpr std::int64_t kDay = 24 * kHour;
inline constexpr std::int64_t kStart = 1'700'000'000 * kSecond;

/// A sweep whose content tells its number; ten points over 90 ms.
inline LidarScan MakeScan(int number, std::int64_t stamp_ns, int lidar = 0) {
  LidarScan scan;
  scan.lidar_id = lidar;
  scan.stamp_ns = stamp_ns;
  for (int i = 0; i < 10; ++i) {
    scan.points.push_back({{1.0F + static_cast<float>(number), static_cast<float>(i), 0.0F},
                           0.0F,
                           stamp_ns + i * 10 * kMs});
  }
  return scan;
}

inline int NumberOf(const LidarScan& scan) {
  return static_cast<int>(scan.points[0].xyz_m.x()) - 1;
}

/// Stamps of a LiDAR at 10 Hz.
inline std::vector<std::int64_t> Regular(int count) {
  std::vector<std::int64_t> stamps;
  stamps.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) stamps.push_back(kStart + i * kPeriod);
  return stamps;
}

struct Sequenced {
  std::vector<LidarScan> scans;
  TimeReport report;

  std::vector<int> Numbers() const {
    std::vector<int> numbers;
    for (const LidarScan& scan : scans) numbers.push_back(NumberOf(scan));
    return numbers;
  }
  /// How far the stamps are from those of the undisturbed recording, the largest, ns.
  std::int64_t LargestError() const {
    std::int64_t largest = 0;
    for (const LidarScan& scan : scans) {
      const std::int64_t truth = kStart + NumberOf(scan) * kPeriod;
      largest = std::max(largest, std::abs(scan.stamp_ns - truth));
      largest = std::max(largest, std::abs(scan.points[0].t_ns - truth));
    }
    return largest;
  }
};

inline Sequenced Sequence(const std::vector<LidarScan>& scans, double max_lag_s = 0.5) {
  Sequenced result;
  ScanSequencer sequencer(max_lag_s, [&](const LidarScan& scan) { result.scans.push_back(scan); });
  for (const LidarScan& scan : scans) sequencer.Add(scan);
  sequencer.Finish();
  result.report = sequencer.report();
  return result;
}

inline std::vector<LidarScan> WithStamps(const std::vector<std::int64_t>& stamps) {
  std::vector<LidarScan> scans;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    scans.push_back(MakeScan(static_cast<int>(i), stamps[i]));
  }
  return scans;
}

inline Sequenced SequenceStamps(const std::vector<std::int64_t>& stamps) {
  return Sequence(WithStamps(stamps));
}

inline void ExpectSame(const std::vector<LidarScan>& a, const std::vector<LidarScan>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].lidar_id, b[i].lidar_id) << i;
    EXPECT_EQ(a[i].stamp_ns, b[i].stamp_ns) << i;
    ASSERT_EQ(a[i].points.size(), b[i].points.size()) << i;
    for (std::size_t k = 0; k < a[i].points.size(); ++k) {
      EXPECT_EQ(a[i].points[k].t_ns, b[i].points[k].t_ns) << i;
      EXPECT_EQ(a[i].points[k].xyz_m, b[i].points[k].xyz_m) << i;
    }
  }
}

inline void ExpectNothingDone(const TimeReport& report) {
  EXPECT_EQ(report.reordered + report.retimed + report.assumed + report.moved + report.Dropped() +
                report.clock_steps + report.odd_point_times,
            0);
  EXPECT_EQ(report.points, 0);
  EXPECT_THAT(report.remarks, ::testing::IsEmpty());
}

}  // namespace trajlo::testing
