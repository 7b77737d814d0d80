// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/scans/lidar_scan.h"

namespace trajlo::python {

/// Whether the times of points fit the stamps. Arrays do not tell their unit: in another one, a
/// sweep takes a thousandth of the time between stamps, and the run is wrong without any complaint.
/// The first scans of each LiDAR decide.
class SweepWatch {
 public:
  void Note(const LidarScan& scan);
  /// A sentence about what does not fit, given once; empty if all fits, or is not known yet. At the
  /// end, fewer scans are enough.
  std::string TakeDoubt(bool at_end);

 private:
  struct Lidar {
    std::int64_t last_stamp_ns = 0;
    std::vector<double> spans_s;
    std::vector<double> periods_s;
  };
  std::map<int, Lidar> lidars_;
  bool is_told_ = false;
};

}  // namespace trajlo::python
