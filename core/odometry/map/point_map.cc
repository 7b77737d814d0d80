// SPDX-License-Identifier: MIT
#include "core/odometry/map/point_map.h"

#include "core/odometry/map/kd_tree_map.h"
#include "core/odometry/map/voxel_hash_map.h"

namespace trajlo {

std::unique_ptr<PointMap> MakePointMap(const MapOptions& options) {
  if (options.kind == MapKind::kKdTree) return std::make_unique<KdTreeMap>(options);
  return std::make_unique<VoxelHashMap>(options);
}

}  // namespace trajlo
