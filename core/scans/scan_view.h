// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/scans/lidar_scan.h"

namespace trajlo {

/// What a LiDAR sees in a scan, in few numbers: the range in each of some hundred directions.
///
/// The farther a LiDAR moved between two scans, the more their views differ, until nothing of the
/// one is left in the other. So views tell which of two scans came first, and whether time passed
/// between them, whatever their stamps say.
class ScanView {
 public:
  /// Of nothing, which differs from nothing.
  ScanView() = default;
  explicit ScanView(const LidarScan& scan);

  /// The mean of |log(range_a / range_b)| over the directions that both see, each 0.5 at most.
  /// Empty if these are too few to tell anything.
  static std::optional<double> Difference(const ScanView& a, const ScanView& b);

 private:
  /// Mean of log(range / m) by direction; NaN where nothing is seen. Made when first needed.
  const std::vector<float>& LogRanges() const;

  mutable std::vector<Eigen::Vector3f> samples_m_;
  mutable std::vector<float> log_ranges_;
};

}  // namespace trajlo
