// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/scans/lidar_scan.h"
#include "core/scans/lidar_track.h"
#include "core/scans/time_report.h"

namespace trajlo {

/// The owner of time: takes scans as they were recorded, whatever their stamps, and hands them on
/// with times that increase for each LiDAR. LidarTrack tells how. LiDARs keep the order among each
/// other in which their scans came; one whose times do not meet those of the LiDAR that came first
/// is left out as long as that is so.
///
/// A scan that simply goes on is handed on at once and as it is. At the start, five scans of a
/// LiDAR are awaited, or a few more if their stamps are odd; later at most eight are held, and
/// those of other LiDARs that come meanwhile.
class ScanSequencer {
 public:
  using HandOn = std::function<void(const LidarScan&)>;

  /// A LiDAR that is farther than `max_lag_s` from the first one does not meet it.
  ScanSequencer(double max_lag_s, HandOn hand_on);

  void Add(const LidarScan& scan);
  /// No further scans: all that are held are judged.
  void Finish();

  /// A point of the scan that is being handed on is of use.
  void NoteUse() {
    report_.until_last_point = std::max(report_.until_last_point, handed_on_arrival_ + 1);
  }
  /// The trajectory begins at this time: what was seen before did not tell how the LiDAR moved.
  /// The first call counts.
  void NoteFirstPose(std::int64_t t_ns);

  const TimeReport& report() const { return report_; }

 private:
  struct Entry {
    HeldScan held;
    bool is_judged = false;
    std::int64_t shift_ns = 0;
  };
  using Queue = std::deque<std::unique_ptr<Entry>>;
  struct Sweep {
    std::int64_t begin_ns, arrival;
  };

  void Judge(std::size_t lidar, bool is_final);
  void Apply(const Judgement& judgement);
  void DoubtTheEnd(const HeldScan& dropped);
  void DoubtTheBegin();
  void Release();
  void Describe(std::size_t lidar);
  void CompareSpans();
  void NoteSilence();
  void CompareDrifts();
  void Remark(const std::string& sentence);
  void Hand(const LidarScan& scan, std::int64_t arrival);

  std::int64_t max_lag_ns_;
  HandOn hand_on_;
  TimeReport report_;
  std::int64_t handed_on_arrival_ = 0;  ///< Of the scan that was handed on last.
  std::vector<LidarTrack> tracks_;
  std::vector<bool> is_apart_;
  std::vector<bool> has_return_;  ///< For each LiDAR, whether any point of it is somewhere.
  bool has_pose_ = false;
  std::vector<std::vector<Sweep>> before_pose_;  ///< For each LiDAR, what was handed on until then.
  std::size_t first_lidar_ = 0;
  bool has_times_ = false;  ///< A scan had any; the first LiDAR is the one that had them first.
  std::optional<std::int64_t> dropped_first_ns_;  ///< When the first scan of all began, if dropped.
  Queue queue_;  ///< In the order in which they are to be handed on.
};

}  // namespace trajlo
