// SPDX-License-Identifier: MIT
#include "core/map/point_map.h"

#include "core/map/kd_tree_map.h"
#include "core/map/voxel_hash_map.h"

namespace trajlo {

std::unique_ptr<PointMap> MakePointMap(const MapOptions& options) {
  if (options.kind == MapKind::kKdTree) return std::make_unique<KdTreeMap>(options);
  return std::make_unique<VoxelHashMap>(options);
}

}  // namespace trajlo
