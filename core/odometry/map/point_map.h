// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace trajlo {

enum class MapKind { kVoxelHash, kKdTree };

struct MapOptions {
  MapKind kind = MapKind::kVoxelHash;
  /// Edge of a voxel (paper: 0.4 m indoors, 0.8 m outdoors).
  double voxel_size_m = 0.3;
  int max_points_per_voxel = 20;
  /// A point nearer than this to another of its voxel is not added: otherwise a sensor at rest
  /// fills the voxels with copies of the same rings, and planes are fitted to scan lines.
  double min_point_spacing_m = 0.12;
  /// Voxels farther than this from the sensor are dropped.
  double radius_m = 100.0;
};

/// The most neighbours that a query can ask for.
constexpr int kMaxNeighbors = 20;

/// The answer of a map to one query, nearest first. Positions are single precision relative to
/// `origin_world`, which is near the query: precise however far from the world's origin.
struct Neighbors {
  Eigen::Vector3d origin_world = Eigen::Vector3d::Zero();
  int count = 0;
  float squared_distance[kMaxNeighbors];
  float x[kMaxNeighbors], y[kMaxNeighbors], z[kMaxNeighbors];
};

/// The local map: world points that registration looks up its neighbours in. Queries are
/// const and may run on several threads; insertion and removal may not run beside them.
class PointMap {
 public:
  virtual ~PointMap() = default;

  /// Adds points in the given order, each if its voxel has room and no point too near. Those added
  /// are appended to `accepted` unless it is null.
  virtual void Insert(const std::vector<Eigen::Vector3d>& points_world,
                      std::vector<Eigen::Vector3d>* accepted = nullptr) = 0;
  /// Drops what is farther than `radius_m` from `center_world`.
  virtual void RemoveFar(const Eigen::Vector3d& center_world) = 0;
  /// The `k` <= kMaxNeighbors nearest points that the map can find around `query_world`. Where they
  /// are fewer than `at_least` the map may give none: it need not look at them.
  virtual void Nearest(const Eigen::Vector3d& query_world, int k, int at_least,
                       Neighbors* neighbors) const = 0;

  virtual std::size_t size() const = 0;
  virtual void ForEachPoint(const std::function<void(const Eigen::Vector3d&)>& visit) const = 0;
};

std::unique_ptr<PointMap> MakePointMap(const MapOptions& options);

}  // namespace trajlo
