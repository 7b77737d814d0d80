// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "core/odometry/parallel/thread_pool.h"
#include "core/odometry/segments/segmenter.h"
#include "core/scans/scan_sequencer.h"

namespace trajlo {

/// Everything ahead of the estimator: scans go in as they were recorded, segments come out in
/// order.
///
/// While the estimator takes a segment, another thread of the pool thins the next one, if it is
/// complete. What a segment holds does not depend on that, and no segment waits for a later scan.
class SegmentStream {
 public:
  /// Called on the thread that called Add or Finish.
  using HandOn = std::function<void(SegmentCloud)>;

  /// `threads` must outlive it.
  SegmentStream(const SegmenterOptions& options, ThreadPool* threads, HandOn hand_on);
  SegmentStream(const SegmentStream&) = delete;
  SegmentStream& operator=(const SegmentStream&) = delete;

  void Add(const LidarScan& scan);
  /// No further scans: hands on all that is left.
  void Finish();

  /// Called with every scan that is used, in order, before Add returns; perhaps by another thread,
  /// while the segments of that scan are handed on.
  void OnScan(std::function<void(const LidarScan&)> callback) { on_scan_ = std::move(callback); }

  /// See Segmenter.
  void CorrectClocks(const std::vector<double>& clocks_s) { segmenter_.CorrectClocks(clocks_s); }

  /// The trajectory begins at this time.
  void NoteFirstPose(std::int64_t t_ns) { sequencer_.NoteFirstPose(t_ns); }

  PointCounts point_counts() const;
  const TimeReport& time_report() const { return sequencer_.report(); }
  /// The time spent on the segments that were handed on since the last call.
  double TakeMilliseconds();

 private:
  void Cut(const LidarScan& scan);
  void HandOnComplete();
  void ThinNext();

  ThreadPool* threads_;
  ScanSequencer sequencer_;
  Segmenter segmenter_;
  HandOn hand_on_;
  std::function<void(const LidarScan&)> on_scan_;
  std::optional<SegmentCloud> next_;  ///< Thinned, not handed on yet.
  double next_ms_ = 0.0;              ///< How long that took.
  double handed_on_ms_ = 0.0;
};

}  // namespace trajlo
