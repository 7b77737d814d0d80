// SPDX-License-Identifier: MIT
#include "core/io/recording/excerpt.h"

namespace trajlo {
namespace {

/// Scans of several LiDARs are not quite in the order of their stamps: one that is late by up to
/// this much still belongs to the excerpt.
constexpr std::int64_t kOverlapNs = 1'000'000'000;

/// So many scans in a row behind that are the end; one may have a wrong stamp.
constexpr int kBeyond = 5;
/// A longer step between two stamps is one of a clock, or a wrong stamp.
constexpr std::int64_t kLongestStepNs = 60'000'000'000;

}  // namespace

/// Since the first scan of the recording.
std::int64_t Excerpt::ElapsedNs(const LidarScan& scan) {
  // A LiDAR that has not spoken yet is compared with the first of those that have.
  const auto known = clocks_.find(scan.lidar_id);
  const Clock before = known != clocks_.end() ? known->second
                       : clocks_.empty()      ? Clock{scan.stamp_ns, 0}
                                              : clocks_.begin()->second;
  std::int64_t step_ns = 0;
  const bool counts = !__builtin_sub_overflow(scan.stamp_ns, before.stamp_ns, &step_ns) &&
                      step_ns <= kLongestStepNs && step_ns >= -kLongestStepNs;
  const Clock now{scan.stamp_ns, before.elapsed_ns + (counts ? step_ns : 0)};
  clocks_[scan.lidar_id] = now;
  return now.elapsed_ns;
}

bool Excerpt::Next(LidarScan* scan) {
  const bool found = FindNext(scan);
  UpdateReport(report_.scans_read + (found ? 1 : 0),
               report_.points_read + (found ? scan->points.size() : 0));
  return found;
}

bool Excerpt::FindNext(LidarScan* scan) {
  while (whole_->Next(scan)) {
    const std::int64_t elapsed_ns = ElapsedNs(*scan);
    if (elapsed_ns < start_ns_) continue;
    if (duration_ns_ == 0 || elapsed_ns < start_ns_ + duration_ns_) return true;
    const bool is_beyond = elapsed_ns >= start_ns_ + duration_ns_ + kOverlapNs;
    beyond_ = is_beyond ? beyond_ + 1 : 0;
    if (beyond_ == kBeyond) return false;
  }
  return false;
}

void Excerpt::UpdateReport(std::size_t scans, std::size_t points) {
  report_ = whole_->report();
  report_.scans_read = scans;
  report_.points_read = points;
}

}  // namespace trajlo
