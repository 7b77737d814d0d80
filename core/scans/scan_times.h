// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/scans/lidar_scan.h"

namespace trajlo {

/// When a scan was measured, whatever single points of it say.
struct ScanTimes {
  /// First and last time of the points that belong together; the stamp of a scan without times.
  std::int64_t begin_ns = 0;
  std::int64_t end_ns = 0;
  /// Points farther than `reach_ns` from `center_ns` do not belong to it; 0: all do.
  std::int64_t center_ns = 0;
  std::int64_t reach_ns = 0;
  std::size_t strays = 0;
};

/// Measures a scan. Times that lie no more than `usual_ns` apart are taken as they are; of others,
/// those far from the middle of the scan are strays. Empty for a scan that should have point times
/// and has no points, and for times beyond any calendar (±2^62 ns, the year 2116).
std::optional<ScanTimes> MeasureTimes(const LidarScan& scan, std::int64_t usual_ns);

/// A number that equal scans share, whatever their times, and others practically never.
std::uint64_t Fingerprint(const LidarScan& scan);

/// True if a point of the scan is somewhere: neither at zero nor not finite.
bool HasReturn(const LidarScan& scan);

/// Takes the strays out of the scan.
void RemoveStrays(const ScanTimes& times, LidarScan* scan);

/// Adds `shift_ns` to the stamp and to the times of all points.
void ShiftTimes(std::int64_t shift_ns, LidarScan* scan);

/// Wrong stamps can be any number: these end at the largest or smallest one where they overflow.
std::int64_t Sum(std::int64_t a, std::int64_t b);
std::int64_t Difference(std::int64_t a, std::int64_t b);
/// The absolute difference.
std::int64_t Distance(std::int64_t a, std::int64_t b);

}  // namespace trajlo
