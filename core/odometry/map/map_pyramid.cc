// SPDX-License-Identifier: MIT
#include "core/odometry/map/map_pyramid.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace trajlo {
namespace {

/// Whether a plane of a coarser level is flat there, and the query on it.
bool IsWideAndThin(const Plane& plane, const Eigen::Vector3d& query_world,
                   const PlaneFitOptions& options) {
  const double distance_m = std::abs(plane.normal_world.dot(query_world) - plane.offset_m);
  return plane.thickness_m <= options.half_weight_thickness_m &&
         plane.thickness_m <= options.max_wide_flatness * plane.width_m &&
         distance_m <= options.max_wide_distance_in_widths * plane.width_m;
}

}  // namespace

MapPyramid::MapPyramid(const MapPyramidOptions& options) {
  if (options.levels < 1 || options.levels > kMaxLevels) {
    throw std::invalid_argument("a map pyramid has 1 to " + std::to_string(kMaxLevels) + " levels");
  }
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

bool MapPyramid::FitAt(const Level& level, const Eigen::Vector3d& query_world,
                       const PlaneFitOptions& options, double reach_m, Plane* plane) {
  Neighbors neighbors;
  level.map->Nearest(query_world, options.neighbors, options.min_neighbors, &neighbors);
  if (neighbors.count < options.min_neighbors) return false;
  const double reach = reach_m * level.scale;
  if (neighbors.squared_distance[0] > reach * reach) return false;
  if (!FitPlane(neighbors, options, level.spacing_m, plane)) return false;
  plane->scale = level.scale;
  return true;
}

bool MapPyramid::FindPlane(const Eigen::Vector3d& query_world, const Eigen::Vector3d& ray_world,
                           const PlaneFitOptions& options, double reach_m, Plane* plane) const {
  const auto is_grazed = [&](const Plane& candidate) {
    return std::abs(candidate.normal_world.dot(ray_world)) < options.min_incidence_sine;
  };
  // A wide thin plane has the better normal: where the surface is flat at a coarse level, that one
  // is taken.
  std::array<Plane, kMaxLevels> fits;
  std::array<bool, kMaxLevels> found{};
  const std::size_t count = levels_.size();
  const std::size_t searched_first = options.max_wide_flatness > 0.0 ? 1 : count;
  for (std::size_t i = count; i-- > searched_first;) {
    found[i] = FitAt(levels_[i], query_world, options, reach_m, &fits[i]);
    if (found[i] && IsWideAndThin(fits[i], query_world, options) && !is_grazed(fits[i])) {
      *plane = fits[i];
      return true;
    }
  }
  // Else the finest that is no scan line; a plane along the ray only where there is no other.
  const Plane* grazed = nullptr;
  for (std::size_t i = 0; i < count; ++i) {
    if (i < searched_first) found[i] = FitAt(levels_[i], query_world, options, reach_m, &fits[i]);
    if (!found[i]) continue;
    fits[i].weight /= fits[i].scale;
    if (!is_grazed(fits[i])) {
      *plane = fits[i];
      return true;
    }
    if (grazed == nullptr) grazed = &fits[i];
  }
  if (grazed != nullptr) *plane = *grazed;
  return grazed != nullptr;
}

std::size_t MapPyramid::size() const {
  std::size_t points = 0;
  for (const Level& level : levels_) points += level.map->size();
  return points;
}

}  // namespace trajlo
