// SPDX-License-Identifier: MIT
#include "core/odometry/map/map_level.h"

namespace trajlo {
namespace {

VoxelKey VoxelOf(const VoxelKey& cell) { return {cell.x() >> 1, cell.y() >> 1, cell.z() >> 1}; }

/// Which of the eight.
std::uint32_t CellInVoxel(const VoxelKey& cell) {
  return static_cast<std::uint32_t>((cell.x() & 1) | (cell.y() & 1) << 1 | (cell.z() & 1) << 2);
}

}  // namespace

MapLevel::MapLevel(const MapOptions& options, const PlaneFitOptions& plane)
    : plane_(plane),
      cell_size_(0.5 * options.voxel_size_m),
      inverse_cell_size_(1.0 / cell_size_),
      points_(options.voxel_size_m, options.min_point_spacing_m, options.radius_m,
              plane.min_neighbors) {
  if (options.kind == MapKind::kKdTree) tree_.emplace();
  if (options.shared_planes) cells_.emplace();
}

void MapLevel::Insert(const std::vector<Eigen::Vector3d>& points_world,
                      std::vector<Eigen::Vector3d>* accepted) {
  const std::size_t before = accepted->size();
  points_.Insert(points_world, accepted);
  if (tree_) tree_->Add({accepted->begin() + static_cast<std::ptrdiff_t>(before), accepted->end()});
  if (cells_) cells_->Resize(points_.site_capacity());
}

void MapLevel::RemoveFar(const Eigen::Vector3d& center_world) {
  std::vector<std::uint32_t> changed;
  points_.RemoveFar(center_world, &changed);
  if (changed.empty()) return;
  if (cells_) {
    for (const std::uint32_t site : changed) cells_->Clear(site);
  }
  if (tree_) {
    std::vector<Eigen::Vector3d> left;
    left.reserve(points_.size());
    points_.ForEachPoint([&](const Eigen::Vector3d& p) { left.push_back(p); });
    tree_->Clear();
    tree_->Add(left);
  }
}

void MapLevel::Prefetch(const VoxelKey& cell) const { points_.index().Prefetch(VoxelOf(cell)); }

const VoxelIndex::Entry* MapLevel::FindSite(const VoxelKey& cell) const {
  const VoxelIndex::Entry* entry = points_.index().Find(VoxelOf(cell));
  if (entry == nullptr || entry->site == VoxelIndex::kNoSite) return nullptr;
  if (cells_) cells_->Prefetch(entry->site, CellInVoxel(cell));
  return entry;
}

FittedPlane MapLevel::PlaneAt(const VoxelIndex::Entry& site, const VoxelKey& cell,
                              const Eigen::Vector3d& query_world,
                              Eigen::Vector3d* center_world) const {
  if (!cells_) {
    *center_world = query_world;
    return Fit(query_world);
  }
  *center_world = cell_size_ * (cell.cast<double>().array() + 0.5);
  return cells_->Get(site.site, CellInVoxel(cell), site.points_around,
                     [&] { return Fit(*center_world); });
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
