// SPDX-License-Identifier: MIT
#include "core/odometry/map/map_level.h"

namespace trajlo {

static_assert(VoxelHashMap::kPointsOfSite == PlaneFitOptions::kMinNeighbors,
              "a site is where there can be a plane");

MapLevel::MapLevel(const MapOptions& options, const PlaneFitOptions& plane)
    : plane_(plane),
      cell_size_(0.5 * options.voxel_size_m),
      inverse_cell_size_(1.0 / cell_size_),
      points_(options.voxel_size_m, options.min_point_spacing_m, options.radius_m) {
  if (options.kind == MapKind::kKdTree) tree_.emplace();
  if (options.shared_planes) cells_.emplace();
}

std::vector<MapPoint> MapLevel::Insert(const std::vector<MapPoint>& points) {
  std::vector<MapPoint> accepted = points_.Insert(points);
  if (tree_) tree_->Add(accepted);
  if (cells_) cells_->Resize(points_.site_capacity());
  return accepted;
}

void MapLevel::RemoveFar(const Eigen::Vector3d& center_world) {
  std::vector<std::uint32_t> changed;
  points_.RemoveFar(center_world, &changed);
  if (changed.empty()) return;
  if (cells_) {
    for (const std::uint32_t site : changed) cells_->Clear(site);
  }
  if (tree_) {
    std::vector<MapPoint> left;
    left.reserve(points_.size());
    points_.ForEachPoint([&](const MapPoint& point) { left.push_back(point); });
    tree_->Clear();
    tree_->Add(left);
  }
}

FittedPlane MapLevel::Fit(const Eigen::Vector3d& center_world) const {
  Neighbors neighbors;
  if (tree_) {
    tree_->Nearest(center_world, plane_.neighbors, &neighbors);
  } else {
    points_.Nearest(center_world, plane_.neighbors, &neighbors);
  }
  return FitPlane(neighbors, center_world, plane_, points_.min_point_spacing_m());
}

}  // namespace trajlo
