// SPDX-License-Identifier: MIT
#include "core/odometry/window/enter_map.h"

#include <algorithm>
#include <vector>

#include "core/odometry/window/points_to_world.h"

namespace trajlo {

void EnterMap(const SegmentCloud& cloud, const SE3& T_begin, const SE3& T_end, ThreadPool* threads,
              MapPyramid* map) {
  constexpr std::size_t kChunk = 512;
  const SegmentMotion motion(T_begin, T_end);
  const std::vector<LidarPath> lidars = LidarPaths(cloud.lidar_origins_body_m, T_begin, T_end);
  const std::vector<SegmentPoint>& points = cloud.map_points;
  std::vector<std::vector<MapPoint>> chunks((points.size() + kChunk - 1) / kChunk);
  threads->ParallelFor(chunks.size(), [&](std::size_t i) {
    const std::size_t first = i * kChunk;
    const std::size_t count = std::min(kChunk, points.size() - first);
    chunks[i] = ToMapPoints(motion, lidars, &points[first], count);
    // Most points are in the map already. Several threads find that out sooner than the insertion,
    // which must keep the order.
    map->DropRefused(&chunks[i]);
  });
  std::vector<MapPoint> wanted;
  for (const auto& chunk : chunks) wanted.insert(wanted.end(), chunk.begin(), chunk.end());
  map->Insert(wanted);
}

}  // namespace trajlo
