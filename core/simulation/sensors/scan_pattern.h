// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "manifolds/eigen_abi.h"

namespace trajlo::simulation {

/// One shot of a laser.
struct Firing {
  /// Unit vector in the LiDAR's frame: x forward, y left, z up.
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  /// After the start of the scan.
  std::int64_t offset_ns = 0;
};

/// Where a LiDAR looks, and when. The firings of a scan are numbered in the order in which a
/// driver delivers their points; offsets need not increase strictly (a column of an Ouster fires at
/// once). Immutable, and safe to use from many threads.
class ScanPattern {
 public:
  virtual ~ScanPattern() = default;
  virtual std::int64_t period_ns() const = 0;
  virtual int firings_per_scan() const = 0;
  /// They fire in turn: firing i is one of laser i % lasers().
  virtual int lasers() const = 0;
  /// `scan` counts from the start of the recording: a non-repetitive pattern differs in each scan.
  virtual Firing At(std::int64_t scan, int firing) const = 0;
};

}  // namespace trajlo::simulation
