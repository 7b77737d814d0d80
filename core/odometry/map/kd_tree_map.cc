// SPDX-License-Identifier: MIT
#include "core/odometry/map/kd_tree_map.h"

#include <algorithm>
#include <nanoflann.hpp>

namespace trajlo {

/// nanoflann keeps a logarithmic number of trees, so that points may be added one after another.
struct KdTreeMap::Index {
  struct Cloud {
    std::vector<Eigen::Vector3d> points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const {
      return points[i][static_cast<Eigen::Index>(axis)];
    }
    template <typename Box>
    bool kdtree_get_bbox(Box&) const {
      return false;
    }
  };
  using Tree =
      nanoflann::KDTreeSingleIndexDynamicAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud,
                                                 3>;

  Cloud cloud;
  Tree tree{3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(10)};

  void Add(const std::vector<Eigen::Vector3d>& points) {
    if (points.empty()) return;
    const std::size_t first = cloud.points.size();
    cloud.points.insert(cloud.points.end(), points.begin(), points.end());
    tree.addPoints(first, cloud.points.size() - 1);
  }
};

KdTreeMap::KdTreeMap(const MapOptions& options)
    : store_(options), index_(std::make_unique<Index>()) {}

KdTreeMap::~KdTreeMap() = default;

void KdTreeMap::Insert(const std::vector<Eigen::Vector3d>& points_world,
                       std::vector<Eigen::Vector3d>* accepted) {
  std::vector<Eigen::Vector3d> added;
  store_.Insert(points_world, &added);
  index_->Add(added);
  if (accepted != nullptr) accepted->insert(accepted->end(), added.begin(), added.end());
}

void KdTreeMap::RemoveFar(const Eigen::Vector3d& center_world) {
  const std::size_t before = store_.size();
  store_.RemoveFar(center_world);
  if (store_.size() != before) Rebuild();
}

void KdTreeMap::Rebuild() {
  std::vector<Eigen::Vector3d> points;
  points.reserve(store_.size());
  store_.ForEachPoint([&](const Eigen::Vector3d& p) { points.push_back(p); });
  index_ = std::make_unique<Index>();
  index_->Add(points);
}

void KdTreeMap::Nearest(const Eigen::Vector3d& query_world, int k, int /*at_least*/,
                        Neighbors* neighbors) const {
  std::size_t indices[kMaxNeighbors];
  double squared[kMaxNeighbors];
  neighbors->count = 0;
  neighbors->origin_world = query_world;
  if (index_->cloud.points.empty()) return;
  nanoflann::KNNResultSet<double> result(static_cast<std::size_t>(std::min(k, kMaxNeighbors)));
  result.init(indices, squared);
  index_->tree.findNeighbors(result, query_world.data(), nanoflann::SearchParams());
  neighbors->count = static_cast<int>(result.size());
  for (int i = 0; i < neighbors->count; ++i) {
    const Eigen::Vector3d p = index_->cloud.points[indices[i]] - query_world;
    neighbors->squared_distance[i] = static_cast<float>(squared[i]);
    neighbors->x[i] = static_cast<float>(p.x());
    neighbors->y[i] = static_cast<float>(p.y());
    neighbors->z[i] = static_cast<float>(p.z());
  }
}

}  // namespace trajlo
