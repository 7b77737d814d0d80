// SPDX-License-Identifier: MIT
#include "core/export/surface_map.h"

#include <Eigen/Eigenvalues>

#include "core/odometry/map/kd_tree_index.h"

namespace trajlo {
namespace {

constexpr int kNeighbors = 12;
constexpr int kLeastNeighbors = 5;
constexpr double kReachInVoxels = 5.0;

/// Of the neighbours within reach.
void FitNormal(const Neighbors& near, double reach_m, const Eigen::Vector3f& to_sensor,
               Surfel* surfel) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  int n = 0;
  for (int i = 0; i < near.count; ++i) {
    if (near.squared_distance[i] > reach_m * reach_m) break;  // Nearest first.
    const Eigen::Vector3d p(near.x[i], near.y[i], near.z[i]);
    mean += p;
    squares += p * p.transpose();
    ++n;
  }
  if (n < kLeastNeighbors) return;
  mean /= n;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(squares / n - mean * mean.transpose());
  const Eigen::Vector3d spread = solver.eigenvalues().cwiseMax(0.0);
  if (!(spread.sum() > 0.0)) return;
  surfel->curvature = static_cast<float>(spread[0] / spread.sum());
  surfel->normal = solver.eigenvectors().col(0).cast<float>().normalized();
  if (surfel->normal.dot(to_sensor) < 0.0F) surfel->normal = -surfel->normal;
}

}  // namespace

void SurfaceMap::Add(const PlacedScan& scan) {
  for (std::size_t i = 0; i < scan.points_world_m.size(); ++i) {
    const Eigen::Vector3d& p = scan.points_world_m[i];
    VoxelIndex::Entry& entry = index_[index_.FindOrAdd(VoxelAt(p, 1.0 / voxel_m_))];
    if (entry.block == VoxelIndex::kNoBlock) {
      entry.block = static_cast<std::uint32_t>(cells_.size());
      cells_.emplace_back();
      cells_.back().seen_ns = scan.t_ns;
      cells_.back().seen_from_m = scan.T_world_body.t.cast<float>();
    }
    Cell& cell = cells_[entry.block];
    cell.sum_m += p;
    cell.sum_intensity += scan.intensities[i];
    ++cell.points;
  }
}

std::vector<Surfel> SurfaceMap::Surfels() const {
  std::vector<Surfel> surfels;
  std::vector<MapPoint> points;
  surfels.reserve(cells_.size());
  points.reserve(cells_.size());
  for (const Cell& cell : cells_) {
    const Eigen::Vector3d place = cell.sum_m / cell.points;
    points.push_back({place, cell.seen_from_m - place.cast<float>()});
    surfels.push_back({place, static_cast<float>(cell.sum_intensity / cell.points), cell.seen_ns});
  }
  KdTreeIndex tree;
  tree.Add(points);
  Neighbors near;
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    tree.Nearest(points[i].place_world, kNeighbors, &near);
    FitNormal(near, kReachInVoxels * voxel_m_, points[i].to_sensor_world, &surfels[i]);
  }
  return surfels;
}

}  // namespace trajlo
