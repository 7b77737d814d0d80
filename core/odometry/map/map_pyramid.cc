// SPDX-License-Identifier: MIT
#include "core/odometry/map/map_pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace trajlo {
namespace {

/// A plane is thinner than another if its thickness is below this share of the other's: that of
/// eight neighbours is known to a quarter.
constexpr float kThinner = 0.85F;

/// Whether a place belongs to a plane of a coarser level. Farther off stands something else.
bool IsNear(const FittedPlane& plane, const Eigen::Vector3d& from_center) {
  const float distance_m =
      std::abs(plane.normal_world.dot(from_center.cast<float>()) - plane.offset_m);
  return distance_m <=
         static_cast<float>(PlaneFitOptions::kMaxWideDistanceInWidths) * plane.width_m;
}

}  // namespace

/// Queries on their way from the coarsest level to the finest.
struct MapPyramid::Batch {
  struct Query {
    VoxelKey finest_cell;
    /// The plane found so far, if any.
    FittedPlane plane;
    Eigen::Vector3d center_world;
    int level;
    bool is_wide = false;
    bool is_grazed = false;

    /// By a plane of a finer level. One that is no thinner shows noise, and nothing of the
    /// surface's shape.
    bool IsReplacedBy(const FittedPlane& finer, bool is_finer_grazed,
                      const Eigen::Vector3d& place_world) const {
      if (!plane.exists()) return true;
      if (is_finer_grazed || is_grazed) return is_grazed;
      return finer.thickness_m < kThinner * plane.thickness_m ||
             !IsNear(plane, place_world - center_world);
    }
  };
  const PlaneQuery* asked;
  std::array<Query, kMaxBatch> queries;
  /// Those that are not settled yet.
  std::array<std::uint16_t, kMaxBatch> open;
  std::size_t open_count;
};

MapPyramid::MapPyramid(const MapPyramidOptions& options) : plane_(options.plane) {
  if (options.levels < 1 || options.levels > MapPyramidOptions::kMaxLevels) {
    throw std::invalid_argument("a map pyramid has 1 to " +
                                std::to_string(MapPyramidOptions::kMaxLevels) + " levels");
  }
  MapOptions level = options.finest;
  for (int i = 0; i < options.levels; ++i) {
    levels_.emplace_back(level, options.plane);
    level.voxel_size_m *= 2.0;
    level.min_point_spacing_m *= 2.0;
  }
}

void MapPyramid::Insert(const std::vector<MapPoint>& points) {
  // Points that a level has no use for, because it has others there, are hardly of use to coarser
  // ones.
  std::vector<MapPoint> offered = levels_.front().Insert(points);
  inserted_ += static_cast<std::int64_t>(offered.size());
  for (std::size_t i = 1; i < levels_.size(); ++i) offered = levels_[i].Insert(offered);
}

void MapPyramid::RemoveFar(const Eigen::Vector3d& center_world) {
  for (MapLevel& level : levels_) level.RemoveFar(center_world);
}

void MapPyramid::AskLevel(int i, Batch* batch) const {
  const MapLevel& level = levels_[static_cast<std::size_t>(i)];
  const std::size_t count = batch->open_count;
  const auto min_width_m = static_cast<float>(PlaneFitOptions::kMinWidthInScatters * scatter_m_);
  std::array<VoxelKey, kMaxBatch> cells;
  std::array<VoxelIndex::Slot, kMaxBatch> slots;
  std::array<const VoxelIndex::Entry*, kMaxBatch> sites;
  for (std::size_t j = 0; j < count; ++j) {
    const VoxelKey& finest = batch->queries[batch->open[j]].finest_cell;
    cells[j] = {finest.x() >> i, finest.y() >> i, finest.z() >> i};
    slots[j] = level.Locate(cells[j]);
  }
  for (std::size_t j = 0; j < count; ++j) sites[j] = level.FindSite(slots[j], cells[j]);

  std::size_t still_open = 0;
  for (std::size_t j = 0; j < count; ++j) {
    const std::uint16_t q = batch->open[j];
    batch->open[still_open++] = q;
    if (sites[j] == nullptr) continue;
    const PlaneQuery& asked = batch->asked[q];
    const Eigen::Vector3d center_world =
        level.shares_planes() ? level.CenterOf(cells[j]) : asked.place_world;
    const FittedPlane plane = level.PlaneAt(*sites[j], cells[j], center_world);
    if (!plane.exists() || plane.width_m < min_width_m) continue;
    const bool is_grazed = IsGrazed(plane, asked.ray_world);
    if (!is_grazed && plane.IsBehind(asked.ray_world)) continue;
    Batch::Query& query = batch->queries[q];
    if (!query.IsReplacedBy(plane, is_grazed, asked.place_world)) continue;
    query.plane = plane;
    query.center_world = center_world;
    query.level = i;
    query.is_grazed = is_grazed;
    query.is_wide = i > 0 && !is_grazed && IsWideAndThin(plane) &&
                    IsNear(plane, asked.place_world - center_world);
    if (query.is_wide) --still_open;
  }
  batch->open_count = still_open;
}

bool MapPyramid::IsGrazed(const FittedPlane& plane, const Eigen::Vector3f& ray_world) const {
  const auto sine = static_cast<float>(plane_.min_incidence_sine);
  const float across = plane.normal_world.dot(ray_world);
  return across * across < sine * sine * ray_world.squaredNorm();
}

bool MapPyramid::IsWideAndThin(const FittedPlane& plane) const {
  return plane.thickness_m <= static_cast<float>(PlaneFitOptions::kHalfWeightThickness_m) &&
         plane.thickness_m < static_cast<float>(plane_.max_wide_flatness) * plane.width_m;
}

/// 1 / ((1 + e² / half²) coarseness⁴), of what the thickness l0 exceeds that of noise:
/// e² = l0² - noise².
double MapPyramid::WeightOf(const FittedPlane& plane, double coarseness) const {
  constexpr double kHalf_m = PlaneFitOptions::kHalfWeightThickness_m;
  const double thickness_m = plane.thickness_m;
  const double noise_m = PlaneFitOptions::kThicknessOfNoise * scatter_m_;
  const double excess_m2 = std::max(0.0, thickness_m * thickness_m - noise_m * noise_m);
  const double squared = coarseness * coarseness;
  return 1.0 / ((1.0 + excess_m2 / (kHalf_m * kHalf_m)) * squared * squared);
}

void MapPyramid::FindPlanes(const PlaneQuery* queries, std::size_t count, Plane* planes) const {
  Batch batch;
  batch.asked = queries;
  batch.open_count = count;
  for (std::size_t q = 0; q < count; ++q) {
    batch.open[q] = static_cast<std::uint16_t>(q);
    batch.queries[q].finest_cell = levels_.front().CellOf(queries[q].place_world);
  }
  for (std::size_t i = levels_.size(); i-- > 0;) AskLevel(static_cast<int>(i), &batch);

  for (std::size_t q = 0; q < count; ++q) {
    const Batch::Query& query = batch.queries[q];
    Plane& plane = planes[q];
    plane.weight = 0.0;
    if (!query.plane.exists()) continue;
    plane.normal_world = query.plane.normal_world.cast<double>();
    plane.offset_m = plane.normal_world.dot(query.center_world) + query.plane.offset_m;
    plane.normal_variance_rad2 = query.is_grazed ? std::numeric_limits<double>::infinity()
                                                 : query.plane.normal_variance_rad2;
    plane.coarseness = query.is_wide ? 1.0 : std::ldexp(1.0, query.level);
    plane.weight = WeightOf(query.plane, plane.coarseness);
  }
}

}  // namespace trajlo
