// SPDX-License-Identifier: MIT
#include "core/io/recording/excerpt.h"

namespace trajlo {
namespace {

/// Scans of several LiDARs are not quite in the order of their stamps: one that is late by up to
/// this much still belongs to the excerpt.
constexpr std::int64_t kOverlapNs = 1'000'000'000;

/// This many scans in a row behind that are the end; one may have a wrong stamp.
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
  if (found) {
    ++scans_;
    points_ += scan->points.size();
    points_without_time_ += last_without_time_;
    points_undeclared_ += last_undeclared_;
  }
  UpdateReport();
  return found;
}

bool Excerpt::FindNext(LidarScan* scan) {
  while (NextOfWhole(scan)) {
    const std::int64_t elapsed_ns = ElapsedNs(*scan);
    if (elapsed_ns < start_ns_) continue;
    if (duration_ns_ == 0 || elapsed_ns < start_ns_ + duration_ns_) return true;
    const bool is_beyond = elapsed_ns >= start_ns_ + duration_ns_ + kOverlapNs;
    beyond_ = is_beyond ? beyond_ + 1 : 0;
    if (beyond_ == kBeyond) return false;
  }
  return false;
}

bool Excerpt::NextOfWhole(LidarScan* scan) {
  const ReadReport& report = whole_->report();
  const std::size_t without_time = report.points_without_time;
  const std::size_t undeclared = report.points_undeclared;
  const bool found = whole_->Next(scan);
  last_without_time_ = report.points_without_time - without_time;
  last_undeclared_ = report.points_undeclared - undeclared;
  return found;
}

void Excerpt::UpdateReport() {
  report_ = whole_->report();
  report_.scans_read = scans_;
  report_.points_read = points_;
  report_.points_without_time = points_without_time_;
  report_.points_undeclared = points_undeclared_;
}

}  // namespace trajlo
