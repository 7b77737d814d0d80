// SPDX-License-Identifier: MIT
#include "core/odometry/map/kd_tree_index.h"

#include <algorithm>
#include <nanoflann.hpp>

namespace trajlo {

/// nanoflann keeps a logarithmic number of trees, so that points may be added one after another.
struct KdTreeIndex::Index {
  struct Cloud {
    std::vector<MapPoint> points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const {
      return points[i].place_world[static_cast<Eigen::Index>(axis)];
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
};

KdTreeIndex::KdTreeIndex() : index_(std::make_unique<Index>()) {}
KdTreeIndex::~KdTreeIndex() = default;

void KdTreeIndex::Add(const std::vector<MapPoint>& points) {
  if (points.empty()) return;
  std::vector<MapPoint>& all = index_->cloud.points;
  const std::size_t first = all.size();
  all.insert(all.end(), points.begin(), points.end());
  index_->tree.addPoints(first, all.size() - 1);
}

void KdTreeIndex::Clear() { index_ = std::make_unique<Index>(); }

void KdTreeIndex::Nearest(const Eigen::Vector3d& query_world, int k, Neighbors* neighbors) const {
  std::size_t indices[kMaxNeighbors];
  double squared[kMaxNeighbors];
  neighbors->count = 0;
  neighbors->origin_world = query_world;
  if (index_->cloud.points.empty()) return;
  nanoflann::KNNResultSet<double> result(static_cast<std::size_t>(std::min(k, kMaxNeighbors)));
  result.init(indices, squared);
  // The default parameters: the name of their type has changed.
  index_->tree.findNeighbors(result, query_world.data(), {});
  neighbors->count = static_cast<int>(result.size());
  for (int i = 0; i < neighbors->count; ++i) {
    const MapPoint& found = index_->cloud.points[indices[i]];
    const Eigen::Vector3d p = found.place_world - query_world;
    neighbors->seen_from[i] = SeenFrom(found.to_sensor_world);
    neighbors->squared_distance[i] = static_cast<float>(squared[i]);
    neighbors->x[i] = static_cast<float>(p.x());
    neighbors->y[i] = static_cast<float>(p.y());
    neighbors->z[i] = static_cast<float>(p.z());
  }
}

}  // namespace trajlo
