// SPDX-License-Identifier: MIT
// Looking up 64 planes on the surfaces of a large room: those that the map keeps, or fitted anew to
// eight neighbours each; and inserting a segment's points.
#include <benchmark/benchmark.h>

#include <array>

#include "core/odometry/map/map_pyramid.h"
#include "tests/support/map_points.h"
#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

std::vector<Eigen::Vector3d> SurfacePoints(int count, unsigned seed) {
  testing::Random random(seed);
  const Eigen::Vector3d half(20.0, 12.0, 5.0);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    Eigen::Vector3d p = random.PlaceIn({1, 1, 1});
    Eigen::Index axis = 0;
    p.cwiseAbs().maxCoeff(&axis);
    p[axis] = p[axis] > 0 ? 1.0 : -1.0;
    p = p.cwiseProduct(half);
    p[axis] += random.Gaussian(0.02);
    points.push_back(p);
  }
  return points;
}

void FindPlanes(benchmark::State& state, MapKind kind, bool shared_planes, int levels) {
  MapPyramidOptions options;
  options.finest.kind = kind;
  options.finest.shared_planes = shared_planes;
  options.levels = levels;
  MapPyramid map(options);
  map.Insert(testing::MapPoints(SurfacePoints(400000, 1)));
  constexpr std::size_t kBatch = MapPyramid::kMaxBatch;
  std::vector<PlaneQuery> queries;
  for (const Eigen::Vector3d& place : SurfacePoints(kBatch * 300, 2)) {
    queries.push_back({place, place.cast<float>()});
  }
  std::array<Plane, kBatch> planes;
  std::size_t first = 0;
  std::int64_t found = 0;
  for (auto _ : state) {
    map.FindPlanes(&queries[first], kBatch, planes.data());
    for (const Plane& plane : planes) found += plane.exists();
    first = (first + kBatch) % queries.size();
  }
  const auto asked = state.iterations() * static_cast<std::int64_t>(kBatch);
  state.SetItemsProcessed(asked);
  state.counters["found"] = static_cast<double>(found) / static_cast<double>(asked);
}
BENCHMARK_CAPTURE(FindPlanes, shared, MapKind::kVoxelHash, true, 1);
BENCHMARK_CAPTURE(FindPlanes, shared_pyramid, MapKind::kVoxelHash, true, 4);
BENCHMARK_CAPTURE(FindPlanes, own, MapKind::kVoxelHash, false, 1);
BENCHMARK_CAPTURE(FindPlanes, own_pyramid, MapKind::kVoxelHash, false, 4);
BENCHMARK_CAPTURE(FindPlanes, own_kd_tree, MapKind::kKdTree, false, 1);

void InsertSegment(benchmark::State& state) {
  MapPyramid map(MapPyramidOptions{});
  map.Insert(testing::MapPoints(SurfacePoints(200000, 1)));
  const auto segment = testing::MapPoints(SurfacePoints(3000, 3));
  for (auto _ : state) map.Insert(segment);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(segment.size()));
}
BENCHMARK(InsertSegment);

}  // namespace
}  // namespace trajlo
