// SPDX-License-Identifier: MIT
// Looking up a plane: eight neighbours and their principal components, on the points of a large
// room's surfaces, by each map; and inserting a segment's points.
#include <benchmark/benchmark.h>

#include "core/odometry/map/map_pyramid.h"
#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

std::vector<Eigen::Vector3d> SurfacePoints(int count, unsigned seed) {
  testing::Random random(seed);
  const Eigen::Vector3d half(20.0, 12.0, 5.0);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    Eigen::Vector3d p(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1));
    Eigen::Index axis = 0;
    p.cwiseAbs().maxCoeff(&axis);
    p[axis] = p[axis] > 0 ? 1.0 : -1.0;
    p = p.cwiseProduct(half);
    p[axis] += random.Gaussian(0.02);
    points.push_back(p);
  }
  return points;
}

void FindPlane(benchmark::State& state, MapKind kind, int levels) {
  MapPyramidOptions options;
  options.finest.kind = kind;
  options.levels = levels;
  MapPyramid map(options);
  map.Insert(SurfacePoints(400000, 1));
  const auto queries = SurfacePoints(20000, 2);
  std::size_t i = 0;
  std::size_t found = 0;
  Plane plane;
  for (auto _ : state) {
    found += map.FindPlane(queries[i], queries[i].normalized(), {}, 1.0, &plane);
    benchmark::DoNotOptimize(plane);
    i = (i + 1) % queries.size();
  }
  state.counters["found"] = static_cast<double>(found) / static_cast<double>(state.iterations());
}
BENCHMARK_CAPTURE(FindPlane, voxel_hash, MapKind::kVoxelHash, 1);
BENCHMARK_CAPTURE(FindPlane, voxel_hash_pyramid, MapKind::kVoxelHash, 4);
BENCHMARK_CAPTURE(FindPlane, kd_tree, MapKind::kKdTree, 1);

void InsertSegment(benchmark::State& state) {
  MapPyramid map(MapPyramidOptions{});
  map.Insert(SurfacePoints(200000, 1));
  const auto segment = SurfacePoints(3000, 3);
  for (auto _ : state) map.Insert(segment);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(segment.size()));
}
BENCHMARK(InsertSegment);

}  // namespace
}  // namespace trajlo
