// SPDX-License-Identifier: MIT
#include "core/odometry/map/map_pyramid.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace trajlo {

/// Queries on their way from the coarsest level to the finest.
struct MapPyramid::Batch {
  const Eigen::Vector3d* places;
  const Eigen::Vector3d* rays;
  Plane* planes;
  std::array<VoxelKey, kMaxBatch> cells;  ///< Of the finest level.
  std::array<bool, kMaxBatch> grazed;
  /// Those that are not settled yet.
  std::array<std::uint16_t, kMaxBatch> open;
  std::size_t open_count;
};

MapPyramid::MapPyramid(const MapPyramidOptions& options) : plane_(options.plane) {
  if (options.levels < 1 || options.levels > kMaxLevels) {
    throw std::invalid_argument("a map pyramid has 1 to " + std::to_string(kMaxLevels) + " levels");
  }
  MapOptions level = options.finest;
  for (int i = 0; i < options.levels; ++i) {
    levels_.emplace_back(level, options.plane);
    level.voxel_size_m *= 2.0;
    level.min_point_spacing_m *= 2.0;
  }
}

void MapPyramid::Insert(const std::vector<Eigen::Vector3d>& points_world) {
  // What a level has no use for, because it has points there, is none for the coarser ones either.
  std::vector<Eigen::Vector3d> offered = points_world;
  std::vector<Eigen::Vector3d> accepted;
  for (MapLevel& level : levels_) {
    accepted.clear();
    level.Insert(offered, &accepted);
    offered.swap(accepted);
  }
}

void MapPyramid::RemoveFar(const Eigen::Vector3d& center_world) {
  for (MapLevel& level : levels_) level.RemoveFar(center_world);
}

void MapPyramid::AskLevel(std::size_t i, Batch* batch) const {
  const MapLevel& level = levels_[i];
  const auto shift = static_cast<int>(i);
  const double scale = std::ldexp(1.0, shift);
  std::array<VoxelKey, kMaxBatch> cells;
  std::array<const VoxelIndex::Entry*, kMaxBatch> sites;
  for (std::size_t j = 0; j < batch->open_count; ++j) {
    const VoxelKey& finest = batch->cells[batch->open[j]];
    cells[j] = {finest.x() >> shift, finest.y() >> shift, finest.z() >> shift};
    level.Prefetch(cells[j]);
  }
  for (std::size_t j = 0; j < batch->open_count; ++j) sites[j] = level.FindSite(cells[j]);

  std::size_t still_open = 0;
  for (std::size_t j = 0; j < batch->open_count; ++j) {
    const std::uint16_t q = batch->open[j];
    batch->open[still_open++] = q;
    if (sites[j] == nullptr) continue;
    Eigen::Vector3d center_world;
    const FittedPlane fit = level.PlaneAt(*sites[j], cells[j], batch->places[q], &center_world);
    if (!fit.exists()) continue;
    const Eigen::Vector3d normal = fit.normal_world.cast<double>();
    const bool is_grazed = std::abs(normal.dot(batch->rays[q])) < plane_.min_incidence_sine;
    Plane& plane = batch->planes[q];
    if (is_grazed && plane.exists() && !batch->grazed[q]) continue;
    const double offset_m = fit.offset_m;
    const double distance_m = std::abs(normal.dot(batch->places[q] - center_world) - offset_m);
    const double relative = fit.thickness_m / plane_.half_weight_thickness_m;
    plane.normal_world = normal;
    plane.offset_m = normal.dot(center_world) + offset_m;
    plane.weight = 1.0 / (1.0 + relative * relative);
    plane.scale = scale;
    batch->grazed[q] = is_grazed;
    const bool is_wide_and_thin = i > 0 && !is_grazed && relative <= 1.0 &&
                                  fit.thickness_m < plane_.max_wide_flatness * fit.width_m &&
                                  distance_m <= plane_.max_wide_distance_in_widths * fit.width_m;
    if (is_wide_and_thin) {
      --still_open;
    } else {
      plane.weight /= scale;
    }
  }
  batch->open_count = still_open;
}

void MapPyramid::FindPlanes(const Eigen::Vector3d* places_world, const Eigen::Vector3d* rays_world,
                            std::size_t count, Plane* planes) const {
  Batch batch;
  batch.places = places_world;
  batch.rays = rays_world;
  batch.planes = planes;
  batch.open_count = count;
  for (std::size_t q = 0; q < count; ++q) {
    batch.open[q] = static_cast<std::uint16_t>(q);
    batch.cells[q] = levels_.front().CellOf(places_world[q]);
    planes[q].weight = 0.0;
  }
  for (std::size_t i = levels_.size(); i-- > 0;) AskLevel(i, &batch);
}

Plane MapPyramid::FindPlane(const Eigen::Vector3d& place_world,
                            const Eigen::Vector3d& ray_world) const {
  Plane plane;
  FindPlanes(&place_world, &ray_world, 1, &plane);
  return plane;
}

std::size_t MapPyramid::size() const {
  std::size_t points = 0;
  for (const MapLevel& level : levels_) points += level.points().size();
  return points;
}

}  // namespace trajlo
