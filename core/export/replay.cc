// SPDX-License-Identifier: MIT
#include "core/export/replay.h"

#include "core/scans/scan_sequencer.h"

namespace trajlo {

PlacementCounts ReplayRecording(const RunResult& result, ScanSource* recording,
                                const std::function<bool(const PlacedScan&)>& visit) {
  const SegmenterOptions& segmenter = result.config.odometry.segmenter;
  ScanPlacer placer(&result.trajectory, segmenter);
  bool goes_on = true;
  ScanSequencer sequencer(segmenter.max_lag_s, [&](const LidarScan& scan) {
    if (!goes_on) return;
    const std::optional<PlacedScan> placed = placer.Place(scan);
    if (placed) goes_on = visit(*placed);
  });
  LidarScan scan;
  while (goes_on && recording->Next(&scan)) sequencer.Add(scan);
  sequencer.Finish();
  return placer.counts();
}

}  // namespace trajlo
