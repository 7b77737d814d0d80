// SPDX-License-Identifier: MIT
// Time, from the stamps of random scans to segments.
#include "core/odometry/segments/segmenter.h"
#include "core/scans/scan_sequencer.h"
#include "tests/fuzz/fuzzing.h"
#include "tests/fuzz/random_scans.h"

namespace {

using namespace trajlo;

constexpr int kMaxScans = 60;

/// Segments as they come, without holes.
class SegmentCheck {
 public:
  explicit SegmentCheck(Segmenter* segmenter) : segmenter_(*segmenter) {}

  void Drain() {
    while (const auto cloud = segmenter_.Next()) {
      fuzz::Require(!end_ns_ || cloud->begin_ns == *end_ns_, "segments have no holes");
      fuzz::Require(cloud->end_ns > cloud->begin_ns || !end_ns_, "segments have a length");
      fuzz::Require(cloud->registration_points.size() <= cloud->map_points.size(),
                    "what is registered is a part");
      for (const SegmentPoint& point : cloud->map_points) {
        fuzz::Require(point.alpha >= 0.0F && point.alpha <= 1.0F, "points lie in their segment");
        fuzz::Require(point.p_body_m.allFinite(), "points are finite");
      }
      end_ns_ = cloud->end_ns;
      ++count_;
    }
  }
  std::size_t count() const { return count_; }

 private:
  Segmenter& segmenter_;
  std::optional<std::int64_t> end_ns_;
  std::size_t count_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::ByteSource bytes(data, size);
  SegmenterOptions options;
  options.interval_s = bytes.OneOf({0.03, 0.01, 0.1, 0.001});
  options.max_gap_s = bytes.OneOf({1.0, 0.2, 10.0});
  options.max_lag_s = bytes.OneOf({0.5, 0.05});
  fuzz::RandomScans scans(&bytes);
  Segmenter segmenter(options);
  SegmentCheck check(&segmenter);
  std::int64_t points = 0;
  ScanSequencer sequencer(options.max_lag_s, [&](const LidarScan& scan) {
    segmenter.AddScan(scan);
    check.Drain();
  });
  int count = 0;
  for (; count < kMaxScans && !bytes.empty(); ++count) {
    const LidarScan scan = scans.Next();
    points += static_cast<std::int64_t>(scan.points.size());
    sequencer.Add(scan);
  }
  sequencer.Finish();
  segmenter.Finish();
  check.Drain();
  fuzz::Require(sequencer.report().scans == count, "every scan is counted");
  fuzz::Require(segmenter.counts().received + sequencer.report().points == points,
                "every point is counted");
  fuzz::Require(segmenter.counts().Kept() >= 0, "no point is counted twice");
  const double per_scan = (options.max_gap_s + 4.0) / options.interval_s;
  fuzz::Require(static_cast<double>(check.count()) <= 10 + per_scan * count,
                "a scan makes few segments, whatever its stamp");
  return 0;
}
