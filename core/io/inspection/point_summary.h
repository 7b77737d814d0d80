// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/io/point_table.h"
#include "core/scans/lidar_scan.h"

namespace trajlo {

/// The points of a stream of messages.
struct PointSummary {
  std::size_t total = 0;
  /// A coordinate is not finite.
  std::size_t not_finite = 0;
  /// Exactly at the origin, as some drivers write directions without a return.
  std::size_t at_origin = 0;
  std::size_t Returns() const { return total - not_finite - at_origin; }
  /// Points in a message.
  std::size_t fewest = 0, median = 0, most = 0;
  std::size_t empty_messages = 0;
  /// Ranges of the returns, m; zeros if there are none. Median and 99 % are good to 1 cm, beyond 1
  /// km to 10 m.
  double range_min_m = 0.0, range_median_m = 0.0, range_99_m = 0.0, range_max_m = 0.0;
  /// Angles of the returns above the x-y plane of the LiDAR: 1 % are lower, and 1 % are higher;
  /// good to 0.1 degrees. Zeros if there are none.
  double elevation_1_deg = 0.0, elevation_99_deg = 0.0;
  /// The column that says which laser measured a point.
  struct Rings {
    std::size_t distinct = 0;
    std::uint32_t lowest = 0, highest = 0;
  };
  std::optional<Rings> rings;
};

/// Adds up a PointSummary, message by message.
class PointCounter {
 public:
  /// `table` is what `scan` was decoded from.
  void Add(const PointTable& table, const LidarScan& scan);
  PointSummary Summarise() const;

 private:
  /// Of 1 cm up to 1 km, then as many of 10 m, the last for all that is farther.
  static constexpr std::size_t kNearBins = 100'000;
  static constexpr std::size_t kRangeBins = 2 * kNearBins;
  /// Of 0.1 degrees, from straight down to straight up.
  static constexpr std::size_t kElevationBins = 1'800;

  static std::size_t RangeBin(double range_m);
  /// The bin that the returns reach with this share of them, counted from the first.
  double QuantileBin(const std::vector<std::uint64_t>& histogram, double share) const;
  double RangeQuantile(double share) const;
  double ElevationQuantile(double share) const;

  PointSummary summary_;
  std::vector<std::size_t> points_per_message_;
  std::vector<std::uint64_t> range_histogram_ = std::vector<std::uint64_t>(kRangeBins);
  std::vector<std::uint64_t> elevation_histogram_ = std::vector<std::uint64_t>(kElevationBins);
  bool has_rings_ = false;
  std::vector<bool> rings_ = std::vector<bool>(65'536);
};

}  // namespace trajlo
