// SPDX-License-Identifier: MIT
#include "core/odometry/segments/segment_stream.h"

#include <utility>

#include "core/odometry/parallel/side_task.h"
#include "core/timing/stopwatch.h"

namespace trajlo {

SegmentStream::SegmentStream(const SegmenterOptions& options, ThreadPool* threads, HandOn hand_on)
    : threads_(threads),
      sequencer_(options.max_lag_s, [this](const LidarScan& scan) { Cut(scan); }),
      segmenter_(options),
      hand_on_(std::move(hand_on)) {}

void SegmentStream::Add(const LidarScan& scan) { sequencer_.Add(scan); }

void SegmentStream::Finish() {
  sequencer_.Finish();
  segmenter_.Finish();
  HandOnComplete();
}

PointCounts SegmentStream::point_counts() const {
  PointCounts counts = segmenter_.counts();
  const std::int64_t of_wrong_scans = sequencer_.report().points;
  counts.wrong_time += of_wrong_scans;
  counts.received += of_wrong_scans;
  return counts;
}

double SegmentStream::TakeMilliseconds() { return std::exchange(handed_on_ms_, 0.0); }

/// A scan whose times follow those of the scan before.
void SegmentStream::Cut(const LidarScan& scan) {
  SideTask notice(threads_);
  if (on_scan_) notice.Start([&] { on_scan_(scan); });
  Stopwatch watch;
  const std::int64_t kept = segmenter_.counts().Kept();
  segmenter_.AddScan(scan);
  if (segmenter_.counts().Kept() > kept) sequencer_.NoteUse();
  handed_on_ms_ += watch.Milliseconds();
  HandOnComplete();
  notice.Wait();
}

void SegmentStream::HandOnComplete() {
  if (!next_) ThinNext();
  while (next_) {
    handed_on_ms_ += next_ms_;
    SegmentCloud segment = *std::exchange(next_, std::nullopt);
    SideTask thinning(threads_);
    thinning.Start([&] { ThinNext(); });
    hand_on_(std::move(segment));
    thinning.Wait();
  }
}

void SegmentStream::ThinNext() {
  Stopwatch watch;
  next_ = segmenter_.Next();
  next_ms_ = watch.Milliseconds();
}

}  // namespace trajlo
