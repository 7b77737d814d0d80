// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>

#include "core/scans/scan_times.h"

namespace trajlo {

/// The last 32 scans that were handed on: what comes again is told from what is new.
class ScanMemory {
 public:
  void Add(std::int64_t begin_ns, const LidarScan& scan) {
    scans_.push_back({begin_ns, Fingerprint(scan)});
    if (scans_.size() > kMost) scans_.pop_front();
  }
  /// True if one of them has the same points.
  bool HasPoints(const LidarScan& scan) const {
    const std::uint64_t fingerprint = Fingerprint(scan);
    return std::any_of(scans_.begin(), scans_.end(),
                       [&](const Known& known) { return known.fingerprint == fingerprint; });
  }
  /// True if not all have the same points, as those of a simulated sensor at rest may.
  bool Varies() const {
    return std::any_of(scans_.begin(), scans_.end(), [&](const Known& known) {
      return known.fingerprint != scans_.front().fingerprint;
    });
  }
  /// True if one of them began within `tolerance_ns` of this time.
  bool HasTime(std::int64_t begin_ns, std::int64_t tolerance_ns) const {
    return std::any_of(scans_.begin(), scans_.end(), [&](const Known& known) {
      return Distance(known.begin_ns, begin_ns) <= tolerance_ns;
    });
  }

 private:
  static constexpr std::size_t kMost = 32;
  struct Known {
    std::int64_t begin_ns;
    std::uint64_t fingerprint;
  };
  std::deque<Known> scans_;
};

}  // namespace trajlo
