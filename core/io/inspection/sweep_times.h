// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/io/inspection/inspection.h"
#include "core/scans/lidar_scan.h"

namespace trajlo {

/// Collects when the sweeps of one LiDAR begin and end.
class SweepTimes {
 public:
  void Add(const LidarScan& scan, std::size_t points_without_time);
  /// Nothing if no scan has times of its own. `period_s` tells neighbours from gaps.
  std::optional<SweepSummary> Summarise(double period_s) const;
  /// The begins of all sweeps; their stamps where points have no times.
  const std::vector<std::int64_t>& begins_ns() const { return begins_ns_; }

 private:
  std::vector<std::int64_t> begins_ns_, ends_ns_, stamps_ns_;
  std::size_t points_without_time_ = 0;
  bool has_times_ = false;
};

/// How the sweeps that begin at `begins_ns` lie against those of the first LiDAR, whose period is
/// `period_s`. Nothing if either has none.
std::optional<SweepPhase> PhaseOf(const std::vector<std::int64_t>& begins_ns,
                                  const std::vector<std::int64_t>& first_lidar_begins_ns,
                                  double period_s);

}  // namespace trajlo
