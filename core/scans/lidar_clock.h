// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "core/scans/lidar_scan.h"
#include "core/scans/recent_median.h"
#include "core/scans/scan_times.h"

namespace trajlo {

/// Where a scan lies in time.
struct ScanPlace {
  std::int64_t begin_ns = 0;  ///< Its first point.
  std::int64_t stamp_ns = 0;
};

/// What is known of the times of one LiDAR: where its last scan was, how often scans come, and how
/// far its clock was moved because of steps. Times that go in and come out are moved already.
class LidarClock {
 public:
  bool has_started() const { return last_.has_value(); }
  /// Of the scan that was noted last.
  const ScanPlace& last() const { return *last_; }
  /// Added to the times as they were recorded.
  std::int64_t offset_ns() const { return offset_ns_; }
  /// The typical time between two scans; 0 while it is unknown.
  std::int64_t period_ns() const { return period_ns_; }
  /// Scans farther apart are more than a few lost ones.
  std::int64_t longest_step_ns() const;
  /// A scan whose times are farther apart is looked at more closely.
  std::int64_t usual_span_ns() const;

  /// With the offset.
  ScanPlace PlaceOf(const LidarScan& scan, const ScanTimes& times) const;
  /// True if that much time between two scans is about one period.
  bool IsPeriod(std::int64_t step_ns) const;
  /// True if it is one period, give or take one and a half: stamps jitter, and a scan may be lost.
  bool IsRoughlyPeriod(std::int64_t step_ns) const;
  /// True if a scan there is the next one at a steady period.
  bool IsNext(std::int64_t begin_ns) const;
  /// The times of recording say whether time passed as `scan` at `place` says: empty if they cannot
  /// tell.
  std::optional<bool> DoRecordTimesAgree(const LidarScan& scan, const ScanPlace& place) const;

  /// By how much the times of recording run ahead of those of the LiDAR, from its first scans to
  /// its last: empty if they cannot tell.
  std::optional<std::int64_t> Drift() const;

  /// Before the first scan is noted: the period that these scans suggest.
  void GuessPeriod(std::vector<std::int64_t> begins_ns, const std::vector<std::int64_t>& spans_ns);
  void set_offset_ns(std::int64_t offset_ns) { offset_ns_ = offset_ns; }
  /// `scan` comes next, at `place`, which lies behind that of the last.
  void Note(const LidarScan& scan, const ScanPlace& place);

 private:
  std::optional<ScanPlace> last_;
  std::int64_t offset_ns_ = 0;
  std::int64_t period_ns_ = 0;
  RecentMedian steps_ns_;
  /// Of the last scans, with the times of their recording.
  struct Recorded {
    std::int64_t begin_ns;
    std::int64_t delay_ns;        ///< From the begin to the recording.
    std::int64_t stamp_delay_ns;  ///< From the stamp, which is there when the first points are not.
  };
  std::deque<Recorded> recorded_;
  std::vector<std::int64_t> first_delays_ns_;
  bool copies_stamps_ = true;  ///< So do all times of recording so far.
};

}  // namespace trajlo
