// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/odometry/segments/segmenter.h"

namespace trajlo {

inline constexpr std::int64_t kMs = 1'000'000;

/// A scan of one point a millisecond, all far apart, the i-th at x = 1000 + first_ms + i.
inline LidarScan MakeScan(std::int64_t first_ms, int count, int lidar = 0) {
  LidarScan scan;
  scan.lidar_id = lidar;
  scan.stamp_ns = first_ms * kMs;
  for (int i = 0; i < count; ++i) {
    scan.points.push_back(
        {{5.0F + static_cast<float>((first_ms + i) % 100), static_cast<float>(10 * lidar), 1.0F},
         0.0F,
         (first_ms + i) * kMs});
  }
  return scan;
}

inline SegmenterOptions SmallOptions() {
  SegmenterOptions options;
  options.interval_s = 0.03;
  options.map_voxel_m = 0.5;
  options.registration_voxel_m = 2.0;
  return options;
}

inline std::vector<SegmentCloud> Drain(Segmenter* segmenter) {
  std::vector<SegmentCloud> clouds;
  while (auto cloud = segmenter->Next()) clouds.push_back(std::move(*cloud));
  return clouds;
}

}  // namespace trajlo
