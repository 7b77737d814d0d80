// SPDX-License-Identifier: MIT
#include "core/map/map_pyramid.h"

#include <cmath>

namespace trajlo {

MapPyramid::MapPyramid(const MapPyramidOptions& options) {
  MapOptions level = options.finest;
  double scale = 1.0;
  for (int i = 0; i < options.levels; ++i) {
    levels_.push_back({MakePointMap(level), scale, level.min_point_spacing_m});
    scale *= options.level_ratio;
    level.voxel_size_m *= options.level_ratio;
    level.min_point_spacing_m *= options.level_ratio;
  }
}

void MapPyramid::Insert(const std::vector<Eigen::Vector3d>& points_world) {
  // What a level has no use for, because it has points there, is none for the coarser ones either.
  std::vector<Eigen::Vector3d> offered = points_world;
  std::vector<Eigen::Vector3d> accepted;
  for (Level& level : levels_) {
    accepted.clear();
    level.map->Insert(offered, &accepted);
    offered.swap(accepted);
  }
}

void MapPyramid::RemoveFar(const Eigen::Vector3d& center_world) {
  for (Level& level : levels_) level.map->RemoveFar(center_world);
}

bool MapPyramid::FindPlane(const Eigen::Vector3d& query_world, const Eigen::Vector3d& ray_world,
                           const PlaneFitOptions& options, double reach_m, Plane* plane) const {
  Neighbors neighbors;
  for (const Level& level : levels_) {
    level.map->Nearest(query_world, options.neighbors, options.min_neighbors, &neighbors);
    if (neighbors.count < options.min_neighbors) continue;
    const double reach = reach_m * level.scale;
    if (neighbors.squared_distance[0] > reach * reach) continue;
    if (!FitPlane(neighbors, options, level.spacing_m, plane)) continue;
    if (std::abs(plane->normal_world.dot(ray_world)) < options.min_incidence_sine) continue;
    plane->weight /= level.scale;
    plane->scale = level.scale;
    return true;
  }
  return false;
}

std::size_t MapPyramid::size() const {
  std::size_t points = 0;
  for (const Level& level : levels_) points += level.map->size();
  return points;
}

}  // namespace trajlo
